#include "trace/bih/kernels.h"

#include "trace/bih/single.h"
#include "trace/each.h"
#include "trace/one_ray.h"

namespace peregrine::trace::bih {

// One ray at a time on every machine.
Kernels make_kernels(base::Isa isa) {
    using Rays = OneRay<Single>;
    return {Rays::closest,
            Rays::occluded,
            closest_each<Rays::closest>,
            occluded_each<Rays::occluded>,
            Rays::visit,
            isa};
}

} // namespace peregrine::trace::bih
