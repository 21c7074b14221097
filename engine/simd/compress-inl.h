// Packs the lanes of a mask. Included once for each instruction set.
#if defined(PEREGRINE_SIMD_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_SIMD_COMPRESS_INL_H
#undef PEREGRINE_SIMD_COMPRESS_INL_H
#else
#define PEREGRINE_SIMD_COMPRESS_INL_H
#endif

#include "simd/wide-inl.h"

#include <array>

HWY_BEFORE_NAMESPACE();
namespace peregrine::simd::HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_SCALAR
// In a register: compressing to memory is slow in hardware.
class Compressor {
public:
    explicit HWY_INLINE Compressor(Mf mask) : mask_(mask) {}
    HWY_INLINE Vf pack(Vf value) const { return hn::Compress(value, mask_); }

private:
    Mf mask_;
};
#else
// hn::Compress of Highway 1.0 copies its table to the stack at each use (GCC 12: 30 times slower),
// so this has its own: for each mask the lanes that are set, in order.
using CompressTable = std::array<std::array<uint8_t, kLanes>, 1u << kLanes>;

constexpr CompressTable make_compress_table() {
    CompressTable table{};
    for (uint32_t bits = 0; bits < table.size(); ++bits)
        for (uint32_t lane = 0, place = 0; lane < kLanes; ++lane)
            if (bits >> lane & 1) table[bits][place++] = uint8_t(lane);
    return table;
}

inline constexpr CompressTable kCompressTable = make_compress_table();

class Compressor {
public:
    explicit HWY_INLINE Compressor(Mf mask) : indices_(find_indices(mask)) {}
    HWY_INLINE Vf pack(Vf value) const { return hn::TableLookupLanes(value, indices_); }

private:
    using Indices = decltype(hn::IndicesFromVec(Df(), hn::Zero(Du())));

    static HWY_INLINE Indices find_indices(Mf mask) {
        uint8_t bits[8] = {};
        hn::StoreMaskBits(kF, mask, bits);
        const auto lanes = hn::LoadU(hn::Rebind<uint8_t, Du>(), kCompressTable[bits[0]].data());
        return hn::IndicesFromVec(kF, hn::PromoteTo(kU, lanes));
    }

    Indices indices_;
};
#endif

} // namespace peregrine::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
