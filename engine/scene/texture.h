#pragma once

#include "base/memory.h"
#include "math/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace peregrine::scene {

enum class Wrap : uint32_t { repeat = 0, mirror = 1, clamp = 2 };
enum class Sampling : uint32_t { bilinear = 0, nearest = 1 };

// Immutable once added. Texels are linear light, row 0 at v = 0: either 4 x 16-bit fixed point
// (65535 = 1: an 8-bit sRGB step is at least 20 of its steps) or 4 x float.
struct Texture {
    enum class Storage : uint32_t { unorm16, float32 };
    static constexpr uint32_t kMostLevels = 16; // of 32768 texels

    explicit Texture(base::Memory* memory) : texels(memory) {}

    uint32_t width = 0;
    uint32_t height = 0;
    Storage storage = Storage::unorm16;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Sampling sampling = Sampling::bilinear;

    // Level 0 is the image; each further one, down to one texel, is half as wide and high, rounded
    // down (texture_levels.h).
    uint32_t level_count = 1;
    std::array<uint32_t, kMostLevels> level_first{}; // texel of each

    base::Vector<std::byte> texels; // 8 or 16 bytes each; levels and their rows tightly packed

    size_t texel_size() const { return storage == Storage::unorm16 ? 8 : 16; }
    uint32_t level_width(uint32_t level) const { return std::max(width >> level, 1u); }
    uint32_t level_height(uint32_t level) const { return std::max(height >> level, 1u); }
};

} // namespace peregrine::scene
