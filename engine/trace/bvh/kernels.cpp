#include "trace/bvh/kernels.h"

#include "trace/bvh/shapes/kernels.h"
#include "trace/bvh/shapes/plain.h"
#include "trace/bvh/single/kernels.h"
#include "trace/bvh/single/plain.h"
#include "trace/bvh/stream/kernels.h"
#include "trace/each.h"
#include "trace/one_ray.h"

namespace peregrine::trace::bvh {
namespace {

using Rays = OneRay<Plain>;
constexpr SingleKernels kPlainSingles = {Rays::closest, Rays::occluded, Rays::visit};
constexpr StreamKernels kPlainStreams = {closest_each<Rays::closest>,
                                         occluded_each<Rays::occluded>};

Kernels make(base::Isa isa, bool compact) {
    const SingleKernels* compiled_singles = single_kernels(isa, compact);
    const StreamKernels* compiled_streams = stream_kernels(isa);
    const SingleKernels& singles = compiled_singles ? *compiled_singles : kPlainSingles;
    const StreamKernels& streams = compiled_streams ? *compiled_streams : kPlainStreams;
    return {singles.closest,     singles.occluded,     streams.closest,
            streams.occluded,    singles.visit,        isa,
            &shape_kernels(isa), &kPlainShapesOfBlocks};
}

} // namespace

Kernels make_kernels(base::Isa isa) {
    return make(isa, false);
}
Kernels make_compact_kernels(base::Isa isa) {
    return make(isa, true);
}

} // namespace peregrine::trace::bvh
