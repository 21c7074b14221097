#pragma once

#include <cstdint>

namespace peregrine::simd {

// For each set of eight 16-bit places the bytes of the set ones first: a shuffle that packs them.
struct CompressShorts {
    alignas(16) uint8_t bytes[256][16];
};

constexpr CompressShorts make_compress_shorts() {
    CompressShorts table{};
    for (uint32_t bits = 0; bits < 256; ++bits)
        for (uint32_t i = 0, place = 0; i < 8; ++i)
            if (bits >> i & 1) {
                table.bytes[bits][2 * place] = uint8_t(2 * i);
                table.bytes[bits][2 * place++ + 1] = uint8_t(2 * i + 1);
            }
    return table;
}

inline constexpr CompressShorts kCompressShorts = make_compress_shorts();

} // namespace peregrine::simd
