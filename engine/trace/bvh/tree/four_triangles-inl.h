// The canonical test for a ray and a block of four triangles. Included once for each instruction
// set.
#if defined(PEREGRINE_TRACE_BVH_TREE_FOUR_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TREE_FOUR_TRIANGLES_INL_H
#undef PEREGRINE_TRACE_BVH_TREE_FOUR_TRIANGLES_INL_H
#else
#define PEREGRINE_TRACE_BVH_TREE_FOUR_TRIANGLES_INL_H
#endif

#include <hwy/highway.h>

#include "accel/bvh/tree.h"
#include "simd/lanes-inl.h"
#include "trace/canonical-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;
using accel::bvh::Block;

struct BlockHits {
    uint32_t lanes; // bits
    uint32_t back_faces;
    alignas(16) float t[4], u[4], v[4]; // of `lanes`
};

// kx, ky, kz are offsets of the ray's axes in a vertex of a block, in floats.
HWY_INLINE HWY_ATTR Sheared<V4> relative_to(const Block& block, size_t kx, size_t ky, size_t kz,
                                            V4 ox, V4 oy, V4 oz, V4 sx, V4 sy) {
    const auto corner = [&](uint32_t vertex, V4 & x, V4 & y, V4 & z) HWY_ATTR
        __attribute__((always_inline)) {
        const float* p = &block.vertex[vertex][0][0];
        z = hn::Sub(hn::Load(k4, p + kz), oz);
        x = shear(hn::Sub(hn::Load(k4, p + kx), ox), sx, z);
        y = shear(hn::Sub(hn::Load(k4, p + ky), oy), sy, z);
    };
    Sheared<V4> s;
    corner(0, s.ax, s.ay, s.az);
    corner(1, s.bx, s.by, s.bz);
    corner(2, s.cx, s.cy, s.cz);
    return s;
}

// What to find out of the triangles that are hit: nothing more, everything, or everything without a
// branch on whether there are any.
enum class Details { none, all, all_at_once };

// The triangles that are hit within [t_min, t_max], t_max being a number; false if there are none.
template <Details details>
HWY_INLINE HWY_ATTR bool decide_block(const Sheared<V4>& s, Vd dz, float t_min, float t_max,
                                      BlockHits& hits) {
    hits.lanes = hits.back_faces = 0;
    for (size_t first = 0; first < 4; first += kLanesD) {
        const auto part = [first](V4 x) HWY_ATTR { return promote_part(x, first); };
        const auto decided =
            decide<false>(part(s.ax), part(s.ay), part(s.bx), part(s.by), part(s.cx), part(s.cy),
                          part(s.az), part(s.bz), part(s.cz), dz);
        const auto in_range =
            hn::And(hn::Ge(decided.t, hn::Set(kFd, t_min)), hn::Le(decided.t, hn::Set(kFd, t_max)));
        const uint32_t lanes = bits_of(kFd, in_range);
        hits.lanes |= lanes << first;
        if (details == Details::none || (details == Details::all && lanes == 0)) continue;
        hn::StoreU(decided.t, kFd, hits.t + first);
        hn::StoreU(decided.u, kFd, hits.u + first);
        hn::StoreU(decided.v, kFd, hits.v + first);
        const hn::RebindToSigned<Dfd> signs;
        const auto facing = hn::Xor(decided.det, hn::DemoteTo(kFd, dz));
        hits.back_faces |= bits_of(signs, hn::Lt(hn::BitCast(signs, facing), hn::Zero(signs)))
                           << first;
    }
    return hits.lanes != 0;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
