// The vectors of the kernels. Their sizes are those of the data, eight and four; machines fill them
// in one or two steps. Included once for each instruction set.
#if defined(PEREGRINE_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_LANES_INL_H
#undef PEREGRINE_SIMD_LANES_INL_H
#else
#define PEREGRINE_SIMD_LANES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Rays of a packet, boxes of a wide node: eight, or four. (Sixteen at a time double the work of
// packets whose rays part.)
using D8 = hn::CappedTag<float, 8>;
using D8u = hn::RebindToUnsigned<D8>;
constexpr D8 k8;
constexpr D8u k8u;
constexpr size_t kLanes8 = hn::MaxLanes(k8);
using V8 = hn::Vec<D8>;
using V8u = hn::Vec<D8u>;
using M8 = hn::Mask<D8>;

// Triangles of a block.
using D4 = hn::CappedTag<float, 4>;
constexpr D4 k4;
using V4 = hn::Vec<D4>;
using M4 = hn::Mask<D4>;

// ... in double: four, or two.
using Dd = hn::CappedTag<double, 4>;
constexpr Dd kD;
constexpr size_t kLanesD = hn::MaxLanes(kD);
using Vd = hn::Vec<Dd>;
using Dfd = hn::Rebind<float, Dd>;
constexpr Dfd kFd;

// Eight lanes in double at once, or half of them.
#if HWY_TARGET == HWY_AVX3
using DHalf = hn::Rebind<double, D8>;
constexpr bool kHalves = false;
#else
using DHalf = Dd;
constexpr bool kHalves = true;
#endif
using VHalf = hn::Vec<DHalf>;

template <class D>
HWY_INLINE HWY_ATTR uint32_t bits_of(D d, hn::Mask<D> mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return bytes[0];
}

// Lanes whose bits are set.
HWY_INLINE HWY_ATTR M8 mask_of(uint32_t bits) {
    const uint8_t bytes[8] = {uint8_t(bits)};
    return hn::LoadMaskBits(k8, bytes);
}

// The smallest, lane by lane, of the halves of a vector of eight.
template <class V>
HWY_INLINE HWY_ATTR V4 least_of_halves(V x) {
    if constexpr (kLanes8 == 4)
        return x;
    else
        return hn::Min(hn::LowerHalf(k4, x), hn::UpperHalf(k4, x));
}

// The largest of the first three lanes, in all lanes.
HWY_INLINE HWY_ATTR V4 largest_of_three(V4 v) {
    return hn::Max(hn::Broadcast<0>(v), hn::Max(hn::Broadcast<1>(v), hn::Broadcast<2>(v)));
}

// Half of eight lanes, or a part of four, as doubles.
HWY_INLINE HWY_ATTR Vd promote_low(V8 x) {
    return hn::PromoteTo(kD, hn::LowerHalf(kFd, x));
}
HWY_INLINE HWY_ATTR Vd promote_high(V8 x) {
    return hn::PromoteTo(kD, hn::UpperHalf(kFd, x));
}
template <class V>
HWY_INLINE HWY_ATTR Vd promote_part(V x, size_t first) {
    if constexpr (kLanesD == 4)
        return hn::PromoteTo(kD, x);
    else
        return first == 0 ? promote_low(x) : promote_high(x);
}

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
