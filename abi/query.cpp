#include "query/single.h"

#include "guard.h"
#include "query_desc.h"
#include "query_options.h"
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
    const auto pointers =
        reinterpret_cast<uintptr_t>(desc.ray_arrays) | reinterpret_cast<uintptr_t>(desc.hit_arrays)
        | reinterpret_cast<uintptr_t>(desc.options) | reinterpret_cast<uintptr_t>(desc.surfaces);
    return desc.ray_count == 1 && (unusual | pointers) == 0;
}

// Calls trace(snapshot, ray) if there is a snapshot, at the world's own origin, and a ray in its
// place.
template <class Trace>
bool with_ray(const HostScene& host, const rt_query_desc& desc, Trace&& trace) {
    // In place: a copy in wide words would wait for the narrow stores of a host that has just put
    // the ray together.
    if (!desc.rays || reinterpret_cast<uintptr_t>(desc.rays) % alignof(math::Ray) != 0)
        return false;
    const scene::SnapshotStore::Pin pin(host.scene.snapshots);
    if (!pin.get() || pin.get()->displaced) return false;
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
[[gnu::noinline]] void trace_any(HostScene& host, const rt_query_desc& desc) {
    const QueryOptions options(desc.options);
    trace::Counters counters;
    query::Request request;
    request.selection = to_selection(desc);
    options.select(request.selection);
    if (desc.flags & RT_QUERY_USE_THREADS) request.scheduler = &host.scene.scheduler;
    if (options.wants_stats()) request.counters = &counters;
    if (desc.ray_count > 0) {
        query::Rays rays = to_rays(desc);
        const auto pin = pin_snapshot(host.scene.snapshots, options.snapshot());
        const auto snapshot = [&]() -> const scene::Snapshot& {
            return require_snapshot(pin, options.snapshot());
        };
        const auto ask = [&](auto&& query, const auto&... results) {
            rays.origin = options.origin_in(snapshot());
            query(snapshot(), rays, request, results...);
        };
        switch (desc.kind) {
        case RT_QUERY_CLOSEST:
            ask(query::closest_hits, to_hits(desc), to_surfaces(desc, desc.ray_count));
            break;
        case RT_QUERY_ANY:
            ask(query::occlusion, to_occluded(desc));
            break;
        case RT_QUERY_ALL:
            ask(query::all_hits, to_hit_lists(desc));
            break;
        case RT_QUERY_COUNT:
            ask(query::count_hits, to_counts(desc));
            break;
        }
    }
    options.write_stats(counters);
}

[[gnu::noinline]] void trace_read(HostScene& host, const rt_query_desc* desc) {
    trace_any(host, read_struct(desc));
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_trace_query(rt_scene scene, const rt_query_desc* desc) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        if (!desc || desc->struct_size != sizeof *desc) [[unlikely]]
            trace_read(host, desc);
        else if (!trace_plain(host, *desc))
            trace_any(host, *desc);
    });
}
