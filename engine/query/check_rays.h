#pragma once

#include "base/scheduler.h"
#include "query/ray_loaders.h"
#include "query/records.h"
#include "query/valid_ray.h"

namespace peregrine::query {

// Throws base::Error invalid_argument that names the first ray that is not valid. The scheduler may
// be null.
void check_rays(const Rays& rays, const RayLoaders& loaders, base::Scheduler* scheduler);

// ... where it is known that one is not.
[[noreturn, gnu::cold]] void reject_first(const Rays& rays);

// Whether all rays are valid. The scheduler may be null.
bool are_all_valid(const Rays& rays, const RayLoaders& loaders, base::Scheduler* scheduler);

// Calls mark(i) for each ray that is not.
template <class Mark>
void for_each_invalid(const Rays& rays, Mark&& mark) {
    for (uint64_t i = 0; i < rays.count; ++i)
        if (!is_valid(rays.load(i))) mark(i);
}

} // namespace peregrine::query
