#pragma once

// The instruction sets that SIMD sources are compiled for; include before <hwy/foreach_target.h>.
// Highway is used as headers alone: each source exports a table per target and selects by
// base/isa.h, so nothing of its run-time library is linked.
#if defined(PEREGRINE_ONE_TARGET)
// Instrumented kernels take minutes to compile, and meet memory and threads in one set as in all.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
