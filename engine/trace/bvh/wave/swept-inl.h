// The space that a set of rays passes through. Included once for each instruction set, where a
// vector has eight floats.
#if defined(PEREGRINE_TRACE_BVH_WAVE_SWEPT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_WAVE_SWEPT_INL_H
#undef PEREGRINE_TRACE_BVH_WAVE_SWEPT_INL_H
#else
#define PEREGRINE_TRACE_BVH_WAVE_SWEPT_INL_H
#endif

#include <hwy/highway.h>

#include "math/box.h"
#include "simd/lanes-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// What rays pass through inside the bounds, from where they begin to where they end.
//
// A hit is closer than 8.1 e D to a point of its triangle (trace/slabs.h), e = 2^-24, and begins
// and ends are off by e (|d t| + |o + d t|) <= e (3.1 D + C), C being the largest |corner|: the
// margin is 32 e (D + C).
class Swept {
public:
    HWY_ATTR explicit Swept(const math::Box& bounds) {
        const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
        for (int k = 0; k < 3; ++k) {
            first_[k] = first_end_[k] = infinity;
            last_[k] = last_end_[k] = hn::Neg(infinity);
            corner_ =
                std::max(corner_, std::max(std::fabs(bounds.lower[k]), std::fabs(bounds.upper[k])));
        }
        reach_ = hn::Zero(k8);
    }

    HWY_INLINE HWY_ATTR void add(M8 rays, const V8 (&o)[3], const V8 (&d)[3], V8 t_near, V8 t_far,
                                 V8 reach) {
        const V8 infinity = hn::Set(k8, std::numeric_limits<float>::infinity());
        for (int k = 0; k < 3; ++k) {
            const V8 begin = hn::MulAdd(d[k], t_near, o[k]), end = hn::MulAdd(d[k], t_far, o[k]);
            first_[k] = hn::Min(first_[k], hn::IfThenElse(rays, begin, infinity));
            last_[k] = hn::Max(last_[k], hn::IfThenElse(rays, begin, hn::Neg(infinity)));
            first_end_[k] = hn::Min(first_end_[k], hn::IfThenElse(rays, end, infinity));
            last_end_[k] = hn::Max(last_end_[k], hn::IfThenElse(rays, end, hn::Neg(infinity)));
        }
        reach_ = hn::Max(reach_, hn::IfThenElseZero(rays, reach));
    }

    // Of the rays of an octant.
    HWY_ATTR float lower(uint32_t k, uint32_t octant) const {
        return hn::GetLane(hn::MinOfLanes(k8, octant >> k & 1 ? first_end_[k] : first_[k]))
               - margin();
    }
    HWY_ATTR float upper(uint32_t k, uint32_t octant) const {
        return hn::GetLane(hn::MaxOfLanes(k8, octant >> k & 1 ? last_[k] : last_end_[k]))
               + margin();
    }

private:
    HWY_ATTR float margin() const {
        return 0x1p-19f * (hn::GetLane(hn::MaxOfLanes(k8, reach_)) + corner_);
    }

    V8 first_[3], last_[3];         // begins
    V8 first_end_[3], last_end_[3]; // ends
    V8 reach_;
    float corner_ = 0;
};

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
