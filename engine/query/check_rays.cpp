#include "query/check_rays.h"

#include "query/valid_ray.h"

namespace peregrine::query {

void check_rays(const Rays& rays, const RayLoaders& loaders) {
    if (rays.moved()) {
        for (uint64_t i = 0; i < rays.count; ++i) check_ray(i, rays.load(i));
        return;
    }
    const bool valid = rays.records ? loaders.check_records(rays.records, rays.stride, rays.count)
                                    : loaders.check_arrays(rays.arrays, rays.count);
    if (!valid) [[unlikely]]
        reject_first(rays);
}

void reject_first(const Rays& rays) {
    for (uint64_t i = 0;; ++i)
        if (const math::Ray ray = rays.load(i); !is_valid(ray)) reject(i, ray);
}

} // namespace peregrine::query
