#include "trace/kernels.h"

#include "trace/kdtree_single.h"
#include "trace/stream_kernels.h"

namespace peregrine::trace {
namespace {

template <bool Filtered>
Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    return fits_float(largest_component(ray.direction), distance)
               ? closest_single<Filtered>(target, ray, filter, distance)
               : closest_single<Filtered>(target, ray, filter,
                                          reach<double>(target.bounds, ray.origin));
}

Hit closest(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty())
        return {std::numeric_limits<float>::infinity(), 0, 0, geometry::kNoTriangle, false, 0};
    return filter.trivial() ? closest<false>(target, ray, filter)
                            : closest<true>(target, ray, filter);
}

template <bool Filtered>
bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    const float distance = reach<float>(target.bounds, ray.origin);
    return fits_float(largest_component(ray.direction), distance)
               ? occluded_single<Filtered>(target, ray, filter, distance)
               : occluded_single<Filtered>(target, ray, filter,
                                           reach<double>(target.bounds, ray.origin));
}

bool occluded(const Target& target, const math::Ray& ray, const Filter& filter) {
    if (target.bounds.empty()) return false;
    return filter.trivial() ? occluded<false>(target, ray, filter)
                            : occluded<true>(target, ray, filter);
}

math::Ray ray_at(const RayStream& rays, uint32_t i) {
    return {{rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]},
            rays.t_min[i],
            {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]},
            rays.t_max[i]};
}

// The streams of machines without SIMD kernels, and what the others are compared with.
void closest_each(const Target& target, const RayStream& rays, const Filter& filter,
                  const HitStream& hits) {
    for (uint32_t i = 0; i < rays.count; ++i) {
        const Hit hit = closest(target, ray_at(rays, i), filter);
        hits.t[i] = hit.t;
        hits.u[i] = hit.u;
        hits.v[i] = hit.v;
        hits.triangle[i] = hit.triangle;
        hits.back_face[i] = hit.back_face;
        if (hits.steps) hits.steps[i] = hit.steps;
    }
}

void occluded_each(const Target& target, const RayStream& rays, const Filter& filter,
                   uint8_t* result) {
    for (uint32_t i = 0; i < rays.count; ++i) result[i] = occluded(target, ray_at(rays, i), filter);
}

Kernels make_kernels(base::Isa isa) {
    const StreamKernels* streams = stream_kernels(isa);
    return {closest, occluded, streams ? streams->closest : closest_each,
            streams ? streams->occluded : occluded_each, isa};
}

} // namespace

const Kernels* select_kernels(base::Isa isa) {
    using base::Isa;
    static const Kernels tables[] = {
        make_kernels(base::best_isa()), make_kernels(Isa::sse4),   make_kernels(Isa::avx2),
        make_kernels(Isa::avx512),      make_kernels(Isa::scalar), make_kernels(Isa::neon),
    };
    const auto index = uint32_t(isa);
    return index < std::size(tables) && base::machine_has(isa) ? &tables[index] : nullptr;
}

} // namespace peregrine::trace
