#pragma once

#include <cstddef>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace peregrine::bench {

// Turns four rows of four floats into columns, which are aligned.
inline void transpose4(const float* rows, size_t stride, float* c0, float* c1, float* c2,
                       float* c3) {
#if defined(__SSE__)
    __m128 r0 = _mm_loadu_ps(rows), r1 = _mm_loadu_ps(rows + stride);
    __m128 r2 = _mm_loadu_ps(rows + 2 * stride), r3 = _mm_loadu_ps(rows + 3 * stride);
    _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
    _mm_store_ps(c0, r0);
    _mm_store_ps(c1, r1);
    _mm_store_ps(c2, r2);
    _mm_store_ps(c3, r3);
#else
    for (size_t i = 0; i < 4; ++i) {
        c0[i] = rows[i * stride];
        c1[i] = rows[i * stride + 1];
        c2[i] = rows[i * stride + 2];
        c3[i] = rows[i * stride + 3];
    }
#endif
}

} // namespace peregrine::bench
