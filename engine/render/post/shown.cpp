#include "render/post/shown.h"

#include "render/post/display_curve.h"
#include "render/post/half.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace peregrine::render::post {
namespace {

constexpr float kMostValue = 1.0f - 0x1p-20f;

struct ToRadiance {
    bool is_compressed;
    float scale;

    explicit ToRadiance(const Frame& frame)
        : is_compressed(frame.tone_mapping == ToneMapping::none), scale(1.0f / frame.exposure) {}

    float operator()(float shown) const {
        const float value = shown * shown;
        if (!is_compressed) return value;
        const float below = std::min(value, kMostValue);
        return below / (1.0f - below) * scale;
    }
};

template <class Channel, class Encode>
void write_row(const Frame& frame, uint32_t x, uint32_t y, uint32_t count,
               const float* const shown[3], Channel alpha, bool swapped, Encode&& encode) {
    struct Pixel {
        Channel c[4];
    };
    std::byte* place =
        static_cast<std::byte*>(frame.pixels) + y * frame.row_stride + uint64_t(x) * sizeof(Pixel);
    const int first = swapped ? 2 : 0;
    for (uint32_t i = 0; i < count; ++i, place += sizeof(Pixel)) {
        const Pixel pixel = {
            {encode(shown[first][i]), encode(shown[1][i]), encode(shown[2 - first][i]), alpha}};
        std::memcpy(place, &pixel, sizeof pixel);
    }
}

} // namespace

void write_shown(const Frame& frame, uint32_t x, uint32_t y, uint32_t count,
                 const float* const shown[3]) {
    const ToRadiance radiance(frame);
    switch (frame.format) {
    case PixelFormat::rgba32f:
        return write_row<float>(frame, x, y, count, shown, 1.0f, false, radiance);
    case PixelFormat::rgba16f:
        return write_row<uint16_t>(frame, x, y, count, shown, to_half(1), false,
                                   [&](float value) { return to_half(radiance(value)); });
    default:
        const DisplayCurve& curve = DisplayCurve::clamp();
        return write_row<uint8_t>(frame, x, y, count, shown, uint8_t(255),
                                  frame.format == PixelFormat::bgra8_srgb,
                                  [&](float value) { return curve.encode(value * value); });
    }
}

} // namespace peregrine::render::post
