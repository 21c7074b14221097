#pragma once

#include "base/scheduler.h"
#include "query/records.h"
#include "query/resolve.h"
#include "scene/snapshot.h"
#include "trace/filter.h"
#include "trace/kernels.h"
#include "trace/visitor.h"

#include <cstddef>
#include <span>

namespace peregrine::query {

// The host's word on a hit that passed everything else: whether it counts. Asked on the thread that
// asks the query; of one ray's hits in any order, about a hit perhaps more than once.
struct Accept {
    bool (*ask)(void* user, uint64_t ray, const Hit& candidate) = nullptr; // null: all count
    void* user = nullptr;

    explicit operator bool() const { return ask != nullptr; }
};

// Which triangles count, in the host's terms, and what it knows of the rays.
struct Selection {
    trace::Faces faces = trace::Faces::both;
    uint32_t layer_mask = ~0u;
    base::Handle ignore_mesh;
    bool alpha_test = false;
    trace::Coherence coherence = trace::Coherence::automatic;
    std::span<const base::Handle> ignore_meshes; // beside ignore_mesh; null and stale ones: nothing
    Accept accept;
    bool skip_separating = false; // sweeps: of shapes that slide (geometry/shapes/slide.h)
};

// A query apart from its rays and results.
struct Request {
    Selection selection;
    base::Scheduler* scheduler = nullptr; // takes part in large batches without `accept`
    trace::Counters* counters = nullptr;  // what the rays took; rays are slower then
    bool mark_invalid = false; // records that are not valid are marked, and the others answered
};

// All of these throw base::Error invalid_argument that names the first ray which is not one: a
// component NaN, an origin infinite or beyond 1e30, a direction infinite or zero. Nothing is
// written then. Or they mark its results (marks.h), if the request wants that. Answers depend on
// neither the scheduler nor the counters.

// The first hit of each ray, and what lies there if `surfaces` are wanted.
void closest_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                  const Hits& hits, const Surfaces& surfaces = {});

// 1 for rays that hit anything, else 0.
void occlusion(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
               const Strided<uint8_t>& occluded);

// The triangles that each ray crosses (geometry/crossing.h), in the order of (t, back_face,
// mesh slot, triangle): each passage through a closed surface once, also on edges and vertices. Of
// those the first `most`; ray i has them from record i * most on, and their number in counts.
// Records beyond that number are left as they are.
struct HitLists {
    std::byte* hits;
    uint32_t stride;
    uint32_t most;
    Strided<uint32_t> counts;
    Surfaces surfaces;          // beside the hits
    Strided<uint32_t> totals{}; // how many there are, beyond `most`; null: not wanted
};
void all_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
              const HitLists& lists);

// ... or how many they are.
void count_hits(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                const Strided<uint32_t>& counts);

} // namespace peregrine::query
