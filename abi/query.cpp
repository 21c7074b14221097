#include "query/single.h"

#include "guard.h"
#include "query_desc.h"
#include "query_records.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

// One ray, everything visible, nothing unusual: what most calls from gameplay code are.
bool is_plain(const rt_query_desc& desc) {
    const uint32_t unusual = uint32_t(desc.faces) | desc.flags | ~desc.layer_mask
                             | desc.ignore_mesh.generation | desc.ray_stride | desc.result_stride
                             | (uint32_t(desc.coherence) & ~uint32_t(RT_COHERENCE_INCOHERENT));
    const auto arrays =
        reinterpret_cast<uintptr_t>(desc.ray_arrays) | reinterpret_cast<uintptr_t>(desc.hit_arrays);
    return desc.ray_count == 1 && (unusual | arrays) == 0;
}

// Calls trace(snapshot, ray) if there is a snapshot and a ray in its place.
template <class Trace>
bool with_ray(const HostScene& host, const rt_query_desc& desc, Trace&& trace) {
    // In place: a copy in wide words would wait for the narrow stores of a host that has just put
    // the ray together.
    if (!desc.rays || reinterpret_cast<uintptr_t>(desc.rays) % alignof(math::Ray) != 0)
        return false;
    const scene::SnapshotStore::Pin pin(host.scene.snapshots);
    if (!pin.get()) return false;
    trace(*pin.get(), *reinterpret_cast<const math::Ray*>(desc.rays));
    return true;
}

// False: ask the long way, which also finds the words for what is wrong.
bool trace_plain(const HostScene& host, const rt_query_desc& desc) {
    if (!is_plain(desc)) return false;
    if (desc.kind == RT_QUERY_CLOSEST && desc.hits)
        return with_ray(host, desc, [&](const scene::Snapshot& snapshot, const math::Ray& ray) {
            query::closest_hit(snapshot, ray, reinterpret_cast<std::byte*>(desc.hits));
        });
    if (desc.kind == RT_QUERY_ANY && desc.occluded)
        return with_ray(host, desc, [&](const scene::Snapshot& snapshot, const math::Ray& ray) {
            *desc.occluded = query::occluded(snapshot, ray);
        });
    return false;
}

// Apart from the short way, so that its registers and stack cost that one nothing.
[[gnu::noinline]] void trace_any(const HostScene& host, const rt_query_desc& desc) {
    const query::Request request{to_selection(desc)};
    if (desc.ray_count == 0) return;
    const query::Rays rays = to_rays(desc);
    if (desc.kind == RT_QUERY_CLOSEST) {
        const query::Hits hits = to_hits(desc);
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        query::closest_hits(require_snapshot(pin), rays, request, hits);
    } else {
        const query::Strided<uint8_t> occluded = to_occluded(desc);
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        query::occlusion(require_snapshot(pin), rays, request, occluded);
    }
}

[[gnu::noinline]] void trace_read(const HostScene& host, const rt_query_desc* desc) {
    trace_any(host, read_struct(desc));
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_trace_query(rt_scene scene, const rt_query_desc* desc) noexcept {
    return guard([&] {
        const HostScene& host = find_scene(scene);
        if (!desc || desc->struct_size != sizeof *desc) [[unlikely]]
            trace_read(host, desc);
        else if (!trace_plain(host, *desc))
            trace_any(host, *desc);
    });
}
