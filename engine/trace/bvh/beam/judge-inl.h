// The canonical test for a facet and the rays of a group. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_JUDGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_JUDGE_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_JUDGE_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_JUDGE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/beam/facet-inl.h"
#include "trace/eight_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;
using namespace trace::HWY_NAMESPACE;

// The facet in all lanes: geometry/intersect.h with what rays of a common origin share taken out
// of the loop.
struct Judge {
    V8 x[3], y[3], z[3];
    VHalf z_double[3];

    HWY_INLINE HWY_ATTR Judge(const float (&vertex)[3][3][4], uint32_t lane) {
        for (int i = 0; i < 3; ++i) {
            x[i] = hn::Set(k8, vertex[i][0][lane]);
            y[i] = hn::Set(k8, vertex[i][1][lane]);
            z[i] = hn::Set(k8, vertex[i][2][lane]);
            z_double[i] = hn::Set(DHalf(), double(vertex[i][2][lane]));
        }
    }
};

// The canonical test of eight rays that share the facet's origin. Inside: they are between the
// edges for sure.
template <bool Inside>
HWY_INLINE HWY_ATTR EightHits judge(const Judge& facet, V8 sx, V8 sy, V8 dz, M8 maybe, V8 t_min,
                                    V8 t_max) {
    const V8 ax = shear(facet.x[0], sx, facet.z[0]), ay = shear(facet.y[0], sy, facet.z[0]);
    const V8 bx = shear(facet.x[1], sx, facet.z[1]), by = shear(facet.y[1], sy, facet.z[1]);
    const V8 cx = shear(facet.x[2], sx, facet.z[2]), cy = shear(facet.y[2], sy, facet.z[2]);
    const auto of = [&](auto part) HWY_ATTR __attribute__((always_inline)) {
        return decide<Inside>(part(ax), part(ay), part(bx), part(by), part(cx), part(cy),
                              facet.z_double[0], facet.z_double[1], facet.z_double[2], part(dz));
    };
    return decide_parts(of, dz, maybe, t_min, t_max);
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
