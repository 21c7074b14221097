#include "query/valid_ray.h"

#include "base/error.h"

#include <cmath>

namespace peregrine::query {

void check_closely(uint64_t index, const math::Ray& ray) {
    if (!is_valid(ray)) reject(index, ray);
}

void reject(uint64_t index, const math::Ray& ray) {
    const auto place = static_cast<unsigned long long>(index);
    const char* names[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
        if (!(std::fabs(ray.origin[k]) <= kLargestOrigin))
            base::fail(base::Code::invalid_argument,
                       "ray %llu: origin %s is %g; it must be finite and at most 1e30 in magnitude",
                       place, names[k], double(ray.origin[k]));
        if (!(std::fabs(ray.direction[k]) <= kLargestFloat))
            base::fail(base::Code::invalid_argument,
                       "ray %llu: direction %s is %g; it must be finite", place, names[k],
                       double(ray.direction[k]));
    }
    if (std::isnan(ray.t_min) || std::isnan(ray.t_max))
        base::fail(base::Code::invalid_argument, "ray %llu: %s is NaN", place,
                   std::isnan(ray.t_min) ? "t_min" : "t_max");
    base::fail(base::Code::invalid_argument, "ray %llu: the direction is zero", place);
}

} // namespace peregrine::query
