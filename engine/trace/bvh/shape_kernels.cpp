// Shapes in the wide BVH, compiled once for each instruction set: boxes and triangles in float,
// with bounds on what that may miss; what they leave open is decided by the canonical tests, which
// no instruction set changes.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/bvh/shape_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "trace/bvh/plain_shapes.h"
#include "trace/bvh/shape_kernels.h"

#if HWY_TARGET != HWY_SCALAR // there the plain kernels do the work
#include "trace/bvh/shape_blocks-inl.h"
#include "trace/bvh/shape_nodes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

// What the filters' products stay within float's normal range for.
inline bool fits_filters(const Volume& volume, double reach) {
    const double speed = largest_component(volume.direction);
    return reach >= 0x1p-30 && reach <= 0x1p24 && largest_component(volume.origin) <= 0x1p40
           && (speed == 0 || (speed >= 0x1p-24 && speed <= 0x1p24));
}

// Calls judge(block, lane) for the triangles of a leaf that filter(block) leaves open, as bits,
// until it returns true.
template <class Filter, class Judge>
HWY_INLINE HWY_ATTR bool visit_blocks(const Target& target, Link leaf, Filter&& filter,
                                      Judge&& judge) {
    const Block* block = target.bvh_blocks + leaf.first_block();
    for (uint32_t left = leaf.count();; ++block, left -= accel::bvh::kBlockWidth) {
        const uint32_t there = left < accel::bvh::kBlockWidth ? (1u << left) - 1 : 15u;
        for (uint32_t open = filter(*block) & there; open; open &= open - 1)
            if (judge(*block, uint32_t(std::countr_zero(open)))) return true;
        if (left <= accel::bvh::kBlockWidth) return false;
    }
}

HWY_ATTR void sweep_shape(const Target& target, const Place& place, const Volume& volume,
                          const SweepQuery& query, FirstHit& best) {
    if (target.bounds.empty()) return;
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.sweep(target, place, volume, query, best);
    const MovingGate gate(volume, reach);
    const SweepFilter filter(volume, reach);
    float t_max = best.limit(query.t_max);
    visit_reached(
        target.bvh_nodes, gate, t_max, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            visit_blocks(
                target, leaf,
                [&](const Block& block) HWY_ATTR
                __attribute__((always_inline)) { return filter.maybe(block, t_max); },
                [&](const Block& block, uint32_t lane) {
                    judge(query, place, vertices_of(block, lane), target.infos,
                          block.triangle[lane], best);
                    t_max = best.limit(query.t_max);
                    return false;
                });
            return false;
        });
}

// Calls visit(block, lane) for the triangles that the shape may touch, until that returns true.
template <class Visit>
HWY_INLINE HWY_ATTR void visit_at_rest(const Target& target, const Volume& volume, double reach,
                                       bool is_ball, Visit&& visit) {
    if (is_ball) {
        const double radius = volume.radius + 0x1p-17 * reach;
        const float limit = float(radius * radius) * (1 + 0x1p-20f);
        const BallGate gate(volume);
        const Vec4 origin = splat(volume.origin);
        const V4 far = hn::Set(k4, float(reach));
        visit_reached(
            target.bvh_nodes, gate, limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
                return visit_blocks(
                    target, leaf,
                    [&](const Block& block) HWY_ATTR __attribute__((always_inline)) {
                        const FourDistances distances(FourTriangles(block, origin), far);
                        return ~bits_of(k4, hn::Gt(distances.low, hn::Set(k4, limit))) & 15;
                    },
                    visit);
            });
        return;
    }
    const BoxGate gate(volume, reach);
    const RestFilter filter(volume, reach);
    const float no_limit = 0;
    visit_reached(
        target.bvh_nodes, gate, no_limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(
                target, leaf,
                [&](const Block& block) HWY_ATTR
                __attribute__((always_inline)) { return filter.maybe(block); },
                visit);
        });
}

HWY_ATTR bool overlaps_shape(const Target& target, const Place& place, const Volume& volume,
                             const OverlapQuery& query) {
    if (target.bounds.empty()) return false;
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.overlaps(target, place, volume, query);
    bool found = false;
    visit_at_rest(target, volume, reach, query.shape.kind == Shape::sphere,
                  [&](const Block& block, uint32_t lane) {
                      return found = judge(query, place, vertices_of(block, lane),
                                           target.infos[block.triangle[lane]]);
                  });
    return found;
}

HWY_ATTR void collect_touched(const Target& target, const Place& place, const Volume& volume,
                              const OverlapQuery& query, Touched& touched) {
    if (target.bounds.empty()) return;
    const double reach = reach_of(target.bounds, volume);
    if (!fits_filters(volume, reach)) [[unlikely]]
        return kPlainShapesOfBlocks.collect(target, place, volume, query, touched);
    visit_at_rest(target, volume, reach, query.shape.kind == Shape::sphere,
                  [&](const Block& block, uint32_t lane) {
                      const geometry::TriangleInfo& info = target.infos[block.triangle[lane]];
                      const uint64_t key = key_of(place, info);
                      if (touched.wants(key) && judge(query, place, vertices_of(block, lane), info))
                          touched.add(key);
                      return false;
                  });
}

HWY_ATTR void nearest_triangle(const Target& target, const Place& place, const Volume& volume,
                               const NearestQuery& query, NearestHit& best) {
    if (target.bounds.empty()) return;
    const double reach = reach_of(target.bounds, with_radius(volume, 0));
    if (!fits_filters(with_radius(volume, 0), reach)) [[unlikely]]
        return kPlainShapesOfBlocks.nearest(target, place, volume, query, best);
    const BallGate gate(volume);
    const Vec4 origin = splat(volume.origin);
    const V4 far = hn::Set(k4, float(reach));
    const auto square_of_limit = [&] {
        const double radius = double(best.limit(query.radius)) * volume.stretch + volume.slack;
        const double widened = std::min(radius + 0x1p-17 * reach, 4 * reach);
        return float(widened * widened) * (1 + 0x1p-20f);
    };
    float limit = square_of_limit();
    visit_reached(
        target.bvh_nodes, gate, limit, [&](Link leaf) HWY_ATTR __attribute__((always_inline)) {
            return visit_blocks(
                target, leaf,
                [&](const Block& block) HWY_ATTR __attribute__((always_inline)) {
                    const FourDistances distances(FourTriangles(block, origin), far);
                    return ~bits_of(k4, hn::Gt(distances.low, hn::Set(k4, limit))) & 15;
                },
                [&](const Block& block, uint32_t lane) {
                    judge(query, place, vertices_of(block, lane), target.infos,
                          block.triangle[lane], best);
                    limit = square_of_limit();
                    return false;
                });
        });
}

[[maybe_unused]] constexpr ShapeKernels kShapes = {sweep_shape, overlaps_shape, collect_touched,
                                                   nearest_triangle};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include "base/simd_select.h"

namespace peregrine::trace::bvh {

const ShapeKernels& shape_kernels(base::Isa isa) {
    const ShapeKernels* kernels = PEREGRINE_TABLE_FOR(isa, kShapes);
    return kernels ? *kernels : kPlainShapesOfBlocks;
}

} // namespace peregrine::trace::bvh
#endif
