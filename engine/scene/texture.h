#pragma once

#include "base/memory.h"
#include "math/vec.h"

#include <cstdint>

namespace peregrine::scene {

enum class Wrap : uint32_t { repeat = 0, mirror = 1, clamp = 2 };
enum class Sampling : uint32_t { bilinear = 0, nearest = 1 };

// Immutable once added. Texels are linear light, row 0 at v = 0: either 4 x 16-bit fixed point
// (65535 = 1: an 8-bit sRGB step is at least 20 of its steps) or 4 x float.
struct Texture {
    enum class Storage : uint32_t { unorm16, float32 };

    explicit Texture(base::Memory* memory) : texels(memory) {}

    uint32_t width = 0;
    uint32_t height = 0;
    Storage storage = Storage::unorm16;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Sampling sampling = Sampling::bilinear;
    base::Vector<std::byte> texels; // 8 or 16 bytes each, rows tightly packed
};

} // namespace peregrine::scene
