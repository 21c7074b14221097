#include "query/resolve.h"

#include "guard.h"
#include "query_records.h"
#include "require_snapshot.h"
#include "scene_table.h"

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_resolve_hits(rt_scene scene, const rt_hit* hits, uint64_t count, uint32_t hit_stride,
                          rt_surface* out_surfaces, uint32_t surface_stride) noexcept {
    return guard([&] {
        const HostScene& host = find_scene(scene);
        if (count == 0) return;
        const auto in = strided<query::Hit>(hits, count, hit_stride, "hits", "hit_stride");
        const auto out = strided<query::Surface>(out_surfaces, count, surface_stride,
                                                 "out_surfaces", "surface_stride");
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        query::resolve(require_snapshot(pin), in, {out.data, out.stride});
    });
}
