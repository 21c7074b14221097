#pragma once

#include "trace/reference_lists.h"
#include "trace/shapes/plain.h"

// The kernels for shapes of structures whose leaves are ranges of references to triangles:
// `Leaves` has lists(target) and visit(target, slabs, leaf), which calls leaf(first, count,
// t_limit).
namespace peregrine::trace {

template <class Leaves>
struct TrianglesOfLists {
    template <class Real, class Visit>
    static uint32_t visit(const Target& target, const Slabs<Real>& slabs, Visit&& visit) {
        const ReferenceLists& lists = Leaves::lists(target);
        return Leaves::visit(target, slabs, [&](uint32_t first, uint32_t count, Real& t_limit) {
            for (uint32_t i = first; i < first + count; ++i) {
                const geometry::Triangle& triangle = lists.triangles[lists.references[i]];
                if (visit(Vertices{triangle.v0, triangle.v1, triangle.v2}, lists.references[i],
                          t_limit))
                    return true;
            }
            return false;
        });
    }
};

template <class Leaves>
inline constexpr const ShapeKernels& kShapesInLists = kPlainShapes<TrianglesOfLists<Leaves>>;

} // namespace peregrine::trace
