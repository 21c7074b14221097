#include "trace/bvh/kernels.h"

#include "trace/bvh/plain.h"
#include "trace/bvh/simd_kernels.h"
#include "trace/each.h"
#include "trace/one_ray.h"
#include "trace/shapes/plain.h"

namespace peregrine::trace::bvh {
namespace {

struct Triangles {
    template <class Real, class Visit>
    static void visit(const Target& target, const Slabs<Real>& slabs, Visit&& visit) {
        visit_triangles(target, slabs, [&](const Block& block, uint32_t lane, Real& t_limit) {
            const auto vertex = [&](int i) {
                return math::Vec3(block.vertex[i][0][lane], block.vertex[i][1][lane],
                                  block.vertex[i][2][lane]);
            };
            return visit(Vertices{vertex(0), vertex(1), vertex(2)}, block.triangle[lane], t_limit);
        });
    }
};

} // namespace

Kernels make_kernels(base::Isa isa) {
    if (const Kernels* simd = simd_kernels(isa)) {
        Kernels kernels = *simd;
        kernels.isa = isa;
        kernels.shapes = plain_shapes<Triangles>();
        return kernels;
    }
    using Rays = OneRay<Plain>;
    return {Rays::closest,
            Rays::occluded,
            closest_each<Rays::closest>,
            occluded_each<Rays::occluded>,
            Rays::visit,
            isa,
            plain_shapes<Triangles>()};
}

} // namespace peregrine::trace::bvh
