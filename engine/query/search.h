#pragma once

#include "query/query.h"

// Queries that the stream kernels do not answer: ray by ray, through trace::Search.
namespace peregrine::query {

inline bool needs_search(const Request& request) {
    return request.selection.accept || request.counters;
}

void search_closest(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                    const Hits& hits, const Surfaces& surfaces);
void search_any(const scene::Snapshot& snapshot, const Rays& rays, const Request& request,
                const Strided<uint8_t>& occluded);

} // namespace peregrine::query
