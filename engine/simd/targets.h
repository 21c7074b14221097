#pragma once

// The instruction sets that SIMD sources are compiled for; include before <hwy/foreach_target.h>.
// Highway is used as headers alone: each source exports a table per target and selects by
// base/isa.h, so nothing of its run-time library is linked.
#if defined(PEREGRINE_ONLY_TARGET) // by CMake's PEREGRINE_TARGETS
#define HWY_DISABLED_TARGETS                                                                       \
    (HWY_SSSE3 | HWY_AVX3_DL | ((HWY_SSE4 | HWY_AVX2 | HWY_AVX3) & ~PEREGRINE_ONLY_TARGET))
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif

// In a source: whether it is being compiled for the baseline of x86 or for no SIMD at all. Kernels
// that have a plain version leave these to it.
#define PEREGRINE_PLAIN_TARGET (HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_SSE2)
