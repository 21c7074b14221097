#pragma once

#include "query/records.h"
#include "scene/snapshot.h"
#include "trace/filter.h"
#include "trace/kernels.h"

#include <cstddef>

namespace peregrine::query {

// Which triangles count, in the host's terms, and what it knows of the rays.
struct Selection {
    trace::Faces faces = trace::Faces::both;
    uint32_t layer_mask = ~0u;
    base::Handle ignore_mesh;
    bool alpha_test = false;
    trace::Coherence coherence = trace::Coherence::automatic;
    bool skip_separating = false; // sweeps: initial contacts that do not get deeper do not count
};

trace::Filter make_filter(const scene::Snapshot& snapshot, const Selection& selection);

// Throw base::Error invalid_argument that names the first ray which is not one: a component NaN, an
// origin infinite or beyond 1e30, a direction infinite or zero. Nothing is written then.
void closest_hits(const scene::Snapshot& snapshot, const Rays& rays, const Selection& selection,
                  const Hits& hits);
void occlusion(const scene::Snapshot& snapshot, const Rays& rays, const Selection& selection,
               const Strided<uint8_t>& occluded);

} // namespace peregrine::query
