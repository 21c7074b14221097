// Eight by eight floats. Included once for each instruction set, where a vector has eight floats.
#if defined(PEREGRINE_SIMD_TRANSPOSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_TRANSPOSE_INL_H
#undef PEREGRINE_SIMD_TRANSPOSE_INL_H
#else
#define PEREGRINE_SIMD_TRANSPOSE_INL_H
#endif

#include <hwy/highway.h>

#include "simd/lanes-inl.h"

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

// Rows become columns.
HWY_INLINE HWY_ATTR void transpose(const V8 (&in)[8], V8 (&out)[8]) {
    __m256 pair[8], quad[8];
    for (int i = 0; i < 8; i += 2) {
        pair[i] = _mm256_unpacklo_ps(in[i].raw, in[i + 1].raw);
        pair[i + 1] = _mm256_unpackhi_ps(in[i].raw, in[i + 1].raw);
    }
    for (int i = 0; i < 8; i += 4) {
        quad[i] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0x44);
        quad[i + 1] = _mm256_shuffle_ps(pair[i], pair[i + 2], 0xEE);
        quad[i + 2] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0x44);
        quad[i + 3] = _mm256_shuffle_ps(pair[i + 1], pair[i + 3], 0xEE);
    }
    for (int i = 0; i < 4; ++i) {
        out[i] = V8{_mm256_permute2f128_ps(quad[i], quad[i + 4], 0x20)};
        out[i + 4] = V8{_mm256_permute2f128_ps(quad[i], quad[i + 4], 0x31)};
    }
}

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
