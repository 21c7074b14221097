#include "query/check_rays.h"

#include "query/spread.h"
#include "query/valid_ray.h"

#include <atomic>

namespace peregrine::query {
namespace {

bool are_valid(const Rays& rays, const RayLoaders& loaders) {
    if (rays.shift) {
        bool valid = true;
        for (uint64_t i = 0; i < rays.count; ++i) valid &= is_valid(rays.load(i));
        return valid;
    }
    return rays.records ? loaders.check_records(rays.records, rays.stride, rays.count)
                        : loaders.check_arrays(rays.arrays, rays.count);
}

} // namespace

bool are_all_valid(const Rays& rays, const RayLoaders& loaders, base::Scheduler* scheduler) {
    std::atomic<bool> valid{true};
    spread(scheduler, rays.count, [&](uint64_t first, uint64_t end) {
        if (!are_valid(rays.part(first, end), loaders))
            valid.store(false, std::memory_order_relaxed);
    });
    return valid.load(std::memory_order_relaxed);
}

void check_rays(const Rays& rays, const RayLoaders& loaders, base::Scheduler* scheduler) {
    if (!are_all_valid(rays, loaders, scheduler)) [[unlikely]]
        reject_first(rays);
}

void reject_first(const Rays& rays) {
    for (uint64_t i = 0;; ++i)
        if (const math::Ray ray = rays.load(i); !is_valid(ray)) reject(i, ray);
}

} // namespace peregrine::query
