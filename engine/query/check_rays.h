#pragma once

#include "base/scheduler.h"
#include "query/ray_loaders.h"
#include "query/records.h"

namespace peregrine::query {

// Throws base::Error invalid_argument that names the first ray that is not valid. The scheduler may
// be null.
void check_rays(const Rays& rays, const RayLoaders& loaders, base::Scheduler* scheduler);

// ... where it is known that one is not.
[[noreturn, gnu::cold]] void reject_first(const Rays& rays);

} // namespace peregrine::query
