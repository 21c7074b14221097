#pragma once

#include "query/records.h"
#include "scene/snapshot.h"
#include "trace/filter.h"
#include "trace/kernels.h"

namespace peregrine::query {

// Fewer rays than this are traced one by one.
inline constexpr uint64_t kSmallestBatch = 8;

// Batches of any size, through the stream kernels. Throw base::Error as query.h says.
void closest_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                   trace::Coherence coherence, const Hits& hits);
void occlusion_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                     trace::Coherence coherence, const Strided<uint8_t>& occluded);

} // namespace peregrine::query
