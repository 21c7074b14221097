#include "render/post/encode.h"

#include "render/post/half.h"
#include "render/post/kernels.h"
#include "render/post/tones.h"

namespace peregrine::render::post {
namespace {

template <class Pixel, class Encode>
void write_pixels(const Plan& plan, const TileBuffers& buffers, Encode&& encode) {
    Pixel pixels[kTileRays];
    const auto& [red, green, blue] = buffers.colors.channel;
    for (uint32_t i = 0; i < buffers.tile.count; ++i) pixels[i] = encode(red[i], green[i], blue[i]);
    store_tile(buffers.tile, pixels, plan.frame.pixels, plan.frame.row_stride);
}

struct Bytes {
    uint8_t c[4];
};
struct Halves {
    uint16_t c[4];
};
struct Floats {
    float c[4];
};

// 8-bit images take their tones on the way: see DisplayCurve.
void write_bytes(const Plan& plan, TileBuffers& buffers, bool swapped) {
    const bool filmic = plan.frame.tone_mapping == ToneMapping::filmic;
    const bool none = plan.frame.tone_mapping == ToneMapping::none;
    const ByteEncoding encoding{filmic ? DisplayCurve::filmic() : DisplayCurve::clamp(),
                                none ? 1.0f : plan.frame.exposure, swapped};
    const auto& [red, green, blue] = buffers.colors.channel;
    const float* const radiance[3] = {red, green, blue};
    uint32_t pixels[kTilePadded];
    kernels(plan.snapshot.isa()).encode_bytes(encoding, radiance, buffers.tile.count, pixels);
    store_tile(buffers.tile, pixels, plan.frame.pixels, plan.frame.row_stride);
}

void write_srgb_rgba(const Plan& plan, TileBuffers& buffers) {
    write_bytes(plan, buffers, false);
}

void write_srgb_bgra(const Plan& plan, TileBuffers& buffers) {
    write_bytes(plan, buffers, true);
}

// Debug views are display values already.
uint8_t to_byte(float value) {
    return uint8_t(clamp01(value) * 255.0f + 0.5f);
}

void write_plain_rgba(const Plan& plan, TileBuffers& buffers) {
    write_pixels<Bytes>(plan, buffers, [](float r, float g, float b) -> Bytes {
        return {{to_byte(r), to_byte(g), to_byte(b), 255}};
    });
}

void write_plain_bgra(const Plan& plan, TileBuffers& buffers) {
    write_pixels<Bytes>(plan, buffers, [](float r, float g, float b) -> Bytes {
        return {{to_byte(b), to_byte(g), to_byte(r), 255}};
    });
}

void write_half(const Plan& plan, TileBuffers& buffers) {
    write_pixels<Halves>(plan, buffers, [](float r, float g, float b) -> Halves {
        return {{to_half(r), to_half(g), to_half(b), to_half(1)}};
    });
}

void write_float(const Plan& plan, TileBuffers& buffers) {
    write_pixels<Floats>(plan, buffers, [](float r, float g, float b) -> Floats {
        return {{r, g, b, 1}};
    });
}

} // namespace

Stage encoder_of(const Frame& frame) {
    const bool shaded = frame.view == View::shaded;
    switch (frame.format) {
    case PixelFormat::rgba8_srgb:
        return shaded ? write_srgb_rgba : write_plain_rgba;
    case PixelFormat::bgra8_srgb:
        return shaded ? write_srgb_bgra : write_plain_bgra;
    case PixelFormat::rgba16f:
        return write_half;
    default:
        return write_float;
    }
}

} // namespace peregrine::render::post
