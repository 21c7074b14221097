#include "trace/bih/kernels.h"

#include "trace/bih/single.h"
#include "trace/each.h"
#include "trace/one_ray.h"
#include "trace/shapes/lists.h"

namespace peregrine::trace::bih {
namespace {

struct Leaves {
    static const ReferenceLists& lists(const Target& target) { return tree_of(target).lists; }
    template <class Real, class Leaf>
    static uint32_t visit(const Target& target, const Slabs<Real>& slabs, Leaf&& leaf) {
        return visit_leaves(target, slabs, leaf);
    }
};

} // namespace

// One ray at a time on every machine.
Kernels make_kernels(base::Isa isa) {
    using Rays = OneRay<Single>;
    return {Rays::closest,
            Rays::occluded,
            closest_each<Rays::closest>,
            occluded_each<Rays::occluded>,
            Rays::visit,
            isa,
            &kShapesInLists<Leaves>,
            &kShapesInLists<Leaves>};
}

} // namespace peregrine::trace::bih
