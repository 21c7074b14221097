// Loads, and what prepares them. Included once for each instruction set.
#if defined(PEREGRINE_SIMD_MEMORY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_MEMORY_INL_H
#undef PEREGRINE_SIMD_MEMORY_INL_H
#else
#define PEREGRINE_SIMD_MEMORY_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

HWY_INLINE HWY_ATTR void prefetch_lines(const void* at, uint32_t lines) {
    for (uint32_t line = 0; line < lines; ++line)
        hwy::Prefetch(static_cast<const char*>(at) + 64 * line);
}

// Eight bytes, or four, as floats.
HWY_INLINE HWY_ATTR V8 load_bytes(const uint8_t* bytes) {
    const hn::Rebind<uint8_t, D8> u8;
    const hn::RebindToSigned<D8> i8;
    return hn::ConvertTo(k8, hn::PromoteTo(i8, hn::LoadU(u8, bytes)));
}

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
