#include "trace/bvh/kernels.h"

#include "trace/bvh/shapes/kernels.h"
#include "trace/bvh/shapes/plain.h"
#include "trace/bvh/single/plain.h"
#include "trace/bvh/stream/kernels.h"
#include "trace/each.h"
#include "trace/one_ray.h"

namespace peregrine::trace::bvh {
namespace {

Kernels make(base::Isa isa, bool compact) {
    if (const Kernels* simd = simd_kernels(isa, compact)) {
        Kernels kernels = *simd;
        kernels.isa = isa;
        kernels.shapes = &shape_kernels(isa);
        kernels.plain_shapes = &kPlainShapesOfBlocks;
        return kernels;
    }
    using Rays = OneRay<Plain>;
    return {Rays::closest,
            Rays::occluded,
            closest_each<Rays::closest>,
            occluded_each<Rays::occluded>,
            Rays::visit,
            isa,
            &shape_kernels(isa),
            &kPlainShapesOfBlocks};
}

} // namespace

Kernels make_kernels(base::Isa isa) {
    return make(isa, false);
}
Kernels make_compact_kernels(base::Isa isa) {
    return make(isa, true);
}

} // namespace peregrine::trace::bvh
