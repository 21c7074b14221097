#pragma once

#include "trace/bvh/single/plain.h"
#include "trace/shapes/plain.h"

namespace peregrine::trace::bvh {

inline Vertices vertices_of(const Block& block, uint32_t lane) {
    const auto vertex = [&](int i) {
        return math::Vec3(block.vertex[i][0][lane], block.vertex[i][1][lane],
                          block.vertex[i][2][lane]);
    };
    return {vertex(0), vertex(1), vertex(2)};
}

struct TrianglesOfBlocks {
    template <class Real, class Visit>
    static uint32_t visit(const Target& target, const Slabs<Real>& slabs, Visit&& visit) {
        return visit_triangles(
            target, slabs, [&](const Block& block, uint32_t lane, Real& t_limit) {
                return visit(vertices_of(block, lane), block.triangle[lane], t_limit);
            });
    }
};

inline constexpr const ShapeKernels& kPlainShapesOfBlocks = kPlainShapes<TrianglesOfBlocks>;

} // namespace peregrine::trace::bvh
