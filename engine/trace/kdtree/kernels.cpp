#include "trace/kdtree/kernels.h"

#include "trace/each.h"
#include "trace/kdtree/single.h"
#include "trace/kdtree/stream_kernels.h"
#include "trace/one_ray.h"
#include "trace/shapes/lists.h"

namespace peregrine::trace::kdtree {
namespace {

struct Leaves {
    static const ReferenceLists& lists(const Target& target) { return tree_of(target).lists; }
    template <class Real, class Leaf>
    static uint32_t visit(const Target& target, const Slabs<Real>& slabs, Leaf&& leaf) {
        return visit_leaves(target, slabs, leaf);
    }
};

} // namespace

Kernels make_kernels(base::Isa isa) {
    using Rays = OneRay<Single>;
    const StreamKernels* streams = stream_kernels(isa);
    return {Rays::closest,
            Rays::occluded,
            streams ? streams->closest : closest_each<Rays::closest>,
            streams ? streams->occluded : occluded_each<Rays::occluded>,
            Rays::visit,
            isa,
            &kShapesInLists<Leaves>,
            &kShapesInLists<Leaves>};
}

} // namespace peregrine::trace::kdtree
