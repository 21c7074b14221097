#pragma once

#include "query/query.h"

namespace peregrine::query {

// Fewer rays than this are traced one by one.
inline constexpr uint64_t kSmallestBatch = 8;

// Batches of any size, through the stream kernels. Throw base::Error as query.h says.
void closest_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                   const Request& request, const Hits& hits, const Surfaces& surfaces);
void occlusion_batch(const scene::Snapshot& snapshot, const Rays& rays, const trace::Filter& filter,
                     const Request& request, const Strided<uint8_t>& occluded);

} // namespace peregrine::query
