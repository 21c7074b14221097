#pragma once

// The instruction sets that SIMD sources are compiled for; include before <hwy/foreach_target.h>.
// Highway is used as headers alone: each source exports a table per target and selects by
// base/isa.h, so nothing of its run-time library is linked.
#if defined(__SANITIZE_THREAD__)
// Instrumented kernels take minutes to compile. Threads meet in one set as in all, ...
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)
#elif defined(__SANITIZE_ADDRESS__)
// ... and the addresses of the widest are much like those of the next.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
