#pragma once

#include "trace/kernels.h"
#include "trace/slabs.h"

namespace peregrine::trace {

// The kernels for one ray in plain C++, given what a structure knows:
//     template <bool Filtered, class Real>
//     static Hit closest(const Target&, const math::Ray&, const Filter&, Real reach);
// occluded likewise, and visit with a Visitor for the filter. Rays whose numbers do not fit float
// take double.
template <class Structure>
class OneRay {
public:
    static Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
        if (target.bounds.empty()) return miss(0);
        return filter.trivial() ? closest<false>(target, ray, filter)
                                : closest<true>(target, ray, filter);
    }

    static bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
        if (target.bounds.empty()) return false;
        return filter.trivial() ? occluded<false>(target, ray, filter)
                                : occluded<true>(target, ray, filter);
    }

    static void visit(const Target& target, const math::Ray& ray, Visitor& visitor) {
        if (target.bounds.empty()) return;
        const float distance = reach<float>(target.bounds, ray.origin);
        if (fits_float(largest_component(ray.direction), distance))
            Structure::visit(target, ray, visitor, distance);
        else
            Structure::visit(target, ray, visitor, reach<double>(target.bounds, ray.origin));
    }

private:
    template <bool Filtered>
    static Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
        const float distance = reach<float>(target.bounds, ray.origin);
        if (fits_float(largest_component(ray.direction), distance))
            return Structure::template closest<Filtered>(target, ray, filter, distance);
        return Structure::template closest<Filtered>(target, ray, filter,
                                                     reach<double>(target.bounds, ray.origin));
    }

    template <bool Filtered>
    static bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
        const float distance = reach<float>(target.bounds, ray.origin);
        if (fits_float(largest_component(ray.direction), distance))
            return Structure::template occluded<Filtered>(target, ray, filter, distance);
        return Structure::template occluded<Filtered>(target, ray, filter,
                                                      reach<double>(target.bounds, ray.origin));
    }
};

} // namespace peregrine::trace
