#include "trace/kdtree/kernels.h"

#include "trace/each.h"
#include "trace/kdtree/single.h"
#include "trace/kdtree/stream_kernels.h"
#include "trace/one_ray.h"

namespace peregrine::trace::kdtree {

Kernels make_kernels(base::Isa isa) {
    using Rays = OneRay<Single>;
    const StreamKernels* streams = stream_kernels(isa);
    return {Rays::closest,
            Rays::occluded,
            streams ? streams->closest : closest_each<Rays::closest>,
            streams ? streams->occluded : occluded_each<Rays::occluded>,
            Rays::visit,
            isa};
}

} // namespace peregrine::trace::kdtree
