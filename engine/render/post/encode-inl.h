// Pixels of bytes. Included once for each instruction set.
#if defined(PEREGRINE_RENDER_POST_ENCODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_RENDER_POST_ENCODE_INL_H
#undef PEREGRINE_RENDER_POST_ENCODE_INL_H
#else
#define PEREGRINE_RENDER_POST_ENCODE_INL_H
#endif

#include "render/post/kernels.h"
#include "simd/wide-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::render::post::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// As DisplayCurve::encode.
HWY_INLINE Vu encode(const DisplayCurve& curve, Vf x) {
    using Curve = DisplayCurve;
    const Vf lowest = splat(Curve::kLowest), highest = splat(Curve::kHighest);
    const Vf low = hn::IfThenElse(hn::Gt(x, lowest), x, lowest);
    const Vu bits = hn::BitCast(kU, hn::IfThenElse(hn::Lt(low, highest), low, highest));
    const Vu bin = hn::Sub(hn::ShiftRight<Curve::kShift>(bits), hn::Set(kU, Curve::kFirstBin));
    const Vu value = hn::GatherIndex(kU, curve.bins(), hn::BitCast(hn::RebindToSigned<Du>(), bin));
    const Vu carried = hn::Add(value, hn::And(bits, hn::Set(kU, Curve::kLowerBits)));
    return hn::ShiftRight<Curve::kShift>(carried);
}

HWY_ATTR void encode_bytes(const ByteEncoding& encoding, const float* const radiance[3],
                           uint32_t count, uint32_t* pixels) {
    const Vf exposure = splat(encoding.exposure);
    const float* const first = radiance[encoding.swapped ? 2 : 0];
    const float* const last = radiance[encoding.swapped ? 0 : 2];
    const auto code = [&](const float* channel, uint32_t i) HWY_ATTR {
        return encode(encoding.curve, hn::Mul(hn::LoadU(kF, channel + i), exposure));
    };
    for (uint32_t i = 0; i < count; i += kLanes) {
        const Vu low = hn::Or(code(first, i), hn::ShiftLeft<8>(code(radiance[1], i)));
        const Vu high = hn::Or(hn::ShiftLeft<16>(code(last, i)), hn::Set(kU, 0xff000000u));
        hn::StoreU(hn::Or(low, high), kU, pixels + i);
    }
}

} // namespace peregrine::render::post::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
