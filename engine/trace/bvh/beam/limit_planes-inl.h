// Planes that a beam's rays end before. Included once for each instruction set.
#if defined(PEREGRINE_TRACE_BVH_BEAM_LIMIT_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_BEAM_LIMIT_PLANES_INL_H
#undef PEREGRINE_TRACE_BVH_BEAM_LIMIT_PLANES_INL_H
#else
#define PEREGRINE_TRACE_BVH_BEAM_LIMIT_PLANES_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"
#include "trace/bvh/beam/beam-inl.h"
#include "trace/bvh/beam/facet-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Shadow rays end just before a surface, which their groups would meet leaf by leaf to find that
// each ray ends before it. So each group gets a plane,
//     h(x, y, z) = a x + b y + c z = 1,   x and y from the beam's centre,
// beyond which none of its rays reaches: a p + b q + c <= 1 / limit. Facets with all corners beyond
// the plane are not hit. With e = 2^-24, D as in Facets and L = |a| + |b| + |c|, the theorem's
// 8.1 e D, twice that where the centre is taken off, the slopes' and the corners' rounding and that
// of h make less than 64 e (1 + D L).
struct LimitPlanes {
    alignas(64) float a[kGroups], b[kGroups], c[kGroups];
    alignas(64) float size[kGroups]; // L

    // Through the ends of three rays of each group, then moved away until no ray reaches it.
    HWY_ATTR explicit LimitPlanes(const Beam& beam) {
        for (uint32_t g = 0; g < kGroups; ++g) {
            a[g] = b[g] = c[g] = size[g] = 0;
            if (beam.groups >> g & 1) find(beam, g);
        }
    }

    // Groups whose plane the facet does not lie beyond.
    HWY_INLINE HWY_ATTR uint32_t find_before(const Facets& facets, uint32_t lane,
                                             uint32_t mask) const {
        V8 x[3], y[3], z[3];
        for (int i = 0; i < 3; ++i) {
            x[i] = hn::Set(k8, facets.across[i][0][lane]);
            y[i] = hn::Set(k8, facets.across[i][1][lane]);
            z[i] = hn::Set(k8, facets.along[i][lane]);
        }
        const V8 reach = hn::Set(k8, 0x1p-17f * facets.reach[lane]);
        const V8 one = hn::Set(k8, 1.0f + 0x1p-17f);
        uint32_t beyond = 0;
        for (uint32_t g = 0; g < kGroups; g += kLanes8) {
            const V8 va = hn::Load(k8, a + g), vb = hn::Load(k8, b + g), vc = hn::Load(k8, c + g);
            const auto height = [&](int i) HWY_ATTR __attribute__((always_inline)) {
                return hn::MulAdd(va, x[i], hn::MulAdd(vb, y[i], hn::Mul(vc, z[i])));
            };
            const V8 least = hn::Min(height(0), hn::Min(height(1), height(2)));
            beyond |= bits_of(k8, hn::Gt(least, hn::MulAdd(reach, hn::Load(k8, size + g), one)))
                      << g;
        }
        return mask & ~beyond;
    }

private:
    HWY_INLINE HWY_ATTR void find(const Beam& beam, uint32_t group) {
        const uint32_t first = group * kGroupRays;
        // Corners of a group in Morton order.
        const uint32_t i = first, j = first + 10, k = first + 21;
        const float wi = 1 / beam.limit[i], wj = 1 / beam.limit[j] - wi,
                    wk = 1 / beam.limit[k] - wi;
        const float pj = beam.p[j] - beam.p[i], pk = beam.p[k] - beam.p[i];
        const float qj = beam.q[j] - beam.q[i], qk = beam.q[k] - beam.q[i];
        const float scale = 1 / (pj * qk - pk * qj);
        float slope_p = (wj * qk - wk * qj) * scale, slope_q = (pj * wk - pk * wj) * scale;
        if (!(std::abs(slope_p) + std::abs(slope_q) < 0x1p60f)) slope_p = slope_q = 0;
        const V8 vp = hn::Set(k8, slope_p), vq = hn::Set(k8, slope_q);
        const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
        V8 least = infinity;
        for (uint32_t r = first; r < first + kGroupRays; r += kLanes8) {
            const V8 limit = hn::Load(k8, beam.limit + r);
            const V8 rest = hn::NegMulAdd(
                vp, hn::Load(k8, beam.p + r),
                hn::NegMulAdd(vq, hn::Load(k8, beam.q + r), hn::Div(hn::Set(k8, 1.0f), limit)));
            least = hn::Min(least, hn::IfThenElse(hn::Lt(limit, hn::Zero(k8)), infinity, rest));
        }
        a[group] = slope_p;
        b[group] = slope_q;
        c[group] = hn::GetLane(hn::MinOfLanes(k8, least));
        size[group] = std::abs(slope_p) + std::abs(slope_q) + std::abs(c[group]);
    }
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
