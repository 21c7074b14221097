#include "query/chosen.h"
#include "query/single.h"

#include "guard.h"
#include "query_desc.h"
#include "query_options.h"
#include "query_records.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"

#include <algorithm>

namespace peregrine::abi {
namespace {

// Whether the descriptor asks for one ray and nothing out of the ordinary, but for `others`.
bool is_one_ray(const rt_query_desc& desc, uint32_t others, const void* options) {
    const uint32_t unusual = others | desc.ray_stride | desc.result_stride | desc.reserved
                             | (uint32_t(desc.coherence) & ~uint32_t(RT_COHERENCE_INCOHERENT));
    const auto pointers =
        reinterpret_cast<uintptr_t>(desc.ray_arrays) | reinterpret_cast<uintptr_t>(desc.hit_arrays)
        | reinterpret_cast<uintptr_t>(options) | reinterpret_cast<uintptr_t>(desc.surfaces);
    return desc.ray_count == 1 && (unusual | pointers) == 0;
}

// Everything is visible: what most calls from gameplay code are.
bool is_plain(const rt_query_desc& desc) {
    return is_one_ray(
        desc, uint32_t(desc.faces) | desc.flags | ~desc.layer_mask | desc.ignore_mesh.generation,
        desc.options);
}

bool is_simple(const rt_query_options& options) {
    return options.struct_size == sizeof options && options.reserved == 0
           && std::ranges::all_of(options.origin, is_coordinate) && options.ignore_count == 0
           && !options.accept && !options.stats;
}

// Some triangles do not count, or the ray is somewhere else: what most other calls are.
bool is_simple(const rt_query_desc& desc) {
    return is_one_ray(desc, desc.flags & ~uint32_t(RT_QUERY_ALPHA_TEST), nullptr)
           && uint32_t(desc.faces) <= uint32_t(RT_FACES_BACK)
           && (!desc.options || is_simple(*desc.options));
}

// In place: a copy in wide words would wait for the narrow stores of a host that has just put the
// ray together. Null: there is none, or it has to be copied.
const math::Ray* ray_in_place(const rt_query_desc& desc) {
    const bool is_aligned = reinterpret_cast<uintptr_t>(desc.rays) % alignof(math::Ray) == 0;
    return is_aligned ? reinterpret_cast<const math::Ray*>(desc.rays) : nullptr;
}

// Calls with(trace), where trace(snapshot, filter, ray, its position if that is not its origin)
// answers what the descriptor asks of one ray; false if there is no place for the answer.
template <class With>
bool with_tracer(const rt_query_desc& desc, With&& with) {
    if (desc.kind == RT_QUERY_CLOSEST && desc.hits)
        return with([&](const scene::Snapshot& snapshot, const trace::Filter& filter,
                        const auto&... ray) {
            query::closest_hit(snapshot, filter, reinterpret_cast<std::byte*>(desc.hits), ray...);
        });
    if (desc.kind == RT_QUERY_ANY && desc.occluded)
        return with(
            [&](const scene::Snapshot& snapshot, const trace::Filter& filter, const auto&... ray) {
                *desc.occluded = query::occluded(snapshot, filter, ray...);
            });
    return false;
}

// These two return false where the long way is the one to go, which also finds the words for what
// is wrong.
bool trace_plain(const HostScene& host, const rt_query_desc& desc) {
    if (!is_plain(desc)) return false;
    return with_tracer(desc, [&](auto&& trace) {
        const math::Ray* const ray = ray_in_place(desc);
        if (!ray) return false;
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        if (!pin.get() || pin.get()->displaced) return false;
        trace(*pin.get(), query::kEverything, *ray);
        return true;
    });
}

[[gnu::noinline]] bool trace_simple(const HostScene& host, const rt_query_desc& desc) {
    if (!is_simple(desc)) return false;
    return with_tracer(desc, [&](auto&& trace) {
        const math::Ray* const ray = ray_in_place(desc);
        if (!ray) return false;
        const auto pin = pin_snapshot(host.scene.snapshots,
                                      desc.options ? desc.options->snapshot : rt_snapshot{});
        if (!pin.get()) return false;
        const scene::Snapshot& snapshot = *pin.get();
        query::Selection selection = selected_meshes(desc);
        selection.alpha_test = (desc.flags & RT_QUERY_ALPHA_TEST) != 0;
        const trace::Filter filter = query::filter_of(snapshot, selection);
        const query::Shift shift{origin_of(desc.options) - snapshot.origin};
        if (shift)
            trace(snapshot, filter, shift.applied(*ray), trace::Position{ray->origin, shift.by});
        else
            trace(snapshot, filter, *ray);
        return true;
    });
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
    request.mark_invalid = (desc.flags & RT_QUERY_MARK_INVALID) != 0;
    if (desc.ray_count > 0) {
        query::Rays rays = to_rays(desc);
        const auto pin = pin_snapshot(host.scene.snapshots, options.snapshot());
        const auto snapshot = [&]() -> const scene::Snapshot& {
            return require_snapshot(pin, options.snapshot());
        };
        const auto ask = [&](auto&& query, const auto&... results) {
            rays.shift = {options.origin_in(snapshot())};
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
        else if (!trace_plain(host, *desc) && !trace_simple(host, *desc))
            trace_any(host, *desc);
    });
}
