#include "query/resolve.h"

#include "guard.h"
#include "query_records.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

void resolve(const HostScene& host, const rt_resolve_desc& desc) {
    require_bits(desc.flags, RT_QUERY_MARK_INVALID, "rt_resolve_desc.flags");
    require_bits(desc.surface_fields, RT_SURFACE_ALL, "rt_resolve_desc.surface_fields");
    require_zero(desc.reserved, "rt_resolve_desc.reserved");
    require_position(desc.origin, "rt_resolve_desc.origin");
    if (desc.hit_count == 0) return;
    const auto hits = strided<query::Hit>(desc.hits, desc.hit_count, desc.hit_stride,
                                          "rt_resolve_desc.hits", "rt_resolve_desc.hit_stride");
    const auto surfaces =
        strided<query::Surface>(desc.surfaces, desc.hit_count, desc.surface_stride,
                                "rt_resolve_desc.surfaces", "rt_resolve_desc.surface_stride");
    const auto pin = pin_snapshot(host.scene.snapshots, desc.snapshot);
    query::resolve(require_snapshot(pin, desc.snapshot), hits,
                   {surfaces.data, surfaces.stride, desc.surface_fields},
                   {desc.origin[0], desc.origin[1], desc.origin[2]},
                   (desc.flags & RT_QUERY_MARK_INVALID) != 0);
}

} // namespace
} // namespace peregrine::abi

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

rt_result rt_resolve_surfaces(rt_scene scene, const rt_resolve_desc* desc) noexcept {
    return guard([&] {
        const HostScene& host = find_scene(scene);
        with_struct(desc, [&](const rt_resolve_desc& fields) { resolve(host, fields); });
    });
}
