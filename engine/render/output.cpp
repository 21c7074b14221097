#include "render/output.h"

#include "render/display_curve.h"
#include "render/half.h"

namespace peregrine::render {
namespace {

float clamp01(float x) {
    return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
}

void map_filmic(float exposure, uint32_t count, TileColors& colors) {
    // Beyond 1e9 the curve is flat; infinity would give NaN.
    for (float* channel : colors.channel)
        for (uint32_t i = 0; i < count; ++i) {
            const float x = channel[i] * exposure;
            channel[i] = clamp01(filmic_tone(x < 1e9f ? x : 1e9f));
        }
}

void map_clamp(float exposure, uint32_t count, TileColors& colors) {
    for (float* channel : colors.channel)
        for (uint32_t i = 0; i < count; ++i) channel[i] = clamp01(channel[i] * exposure);
}

void map_nothing(float, uint32_t, TileColors&) {}

template <class Pixel, class Encode>
void write_pixels(const Frame& frame, const Tile& tile, const TileColors& colors, Encode&& encode) {
    Pixel pixels[kTileRays];
    for (uint32_t i = 0; i < tile.count; ++i)
        pixels[i] = encode(colors.channel[0][i], colors.channel[1][i], colors.channel[2][i]);
    store_tile(tile, pixels, frame.pixels, frame.row_stride);
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
struct Display {
    const DisplayCurve& curve;
    float exposure;

    explicit Display(const Frame& frame)
        : curve(frame.tone_mapping == ToneMapping::filmic ? DisplayCurve::filmic()
                                                          : DisplayCurve::clamp()),
          exposure(frame.tone_mapping == ToneMapping::none ? 1.0f : frame.exposure) {}

    uint8_t operator()(float radiance) const { return curve.encode(radiance * exposure); }
};

void write_srgb_rgba(const Frame& frame, const Tile& tile, const TileColors& colors) {
    const Display display(frame);
    write_pixels<Bytes>(frame, tile, colors, [&](float r, float g, float b) -> Bytes {
        return {{display(r), display(g), display(b), 255}};
    });
}

void write_srgb_bgra(const Frame& frame, const Tile& tile, const TileColors& colors) {
    const Display display(frame);
    write_pixels<Bytes>(frame, tile, colors, [&](float r, float g, float b) -> Bytes {
        return {{display(b), display(g), display(r), 255}};
    });
}

// Debug views are display values already.
uint8_t to_byte(float value) {
    return uint8_t(clamp01(value) * 255.0f + 0.5f);
}

void write_plain_rgba(const Frame& frame, const Tile& tile, const TileColors& colors) {
    write_pixels<Bytes>(frame, tile, colors, [](float r, float g, float b) -> Bytes {
        return {{to_byte(r), to_byte(g), to_byte(b), 255}};
    });
}

void write_plain_bgra(const Frame& frame, const Tile& tile, const TileColors& colors) {
    write_pixels<Bytes>(frame, tile, colors, [](float r, float g, float b) -> Bytes {
        return {{to_byte(b), to_byte(g), to_byte(r), 255}};
    });
}

void write_half(const Frame& frame, const Tile& tile, const TileColors& colors) {
    write_pixels<Halves>(frame, tile, colors, [](float r, float g, float b) -> Halves {
        return {{to_half(r), to_half(g), to_half(b), to_half(1)}};
    });
}

void write_float(const Frame& frame, const Tile& tile, const TileColors& colors) {
    write_pixels<Floats>(frame, tile, colors, [](float r, float g, float b) -> Floats {
        return {{r, g, b, 1}};
    });
}

} // namespace

Output Output::choose(const Frame& frame) {
    Output output{map_nothing, write_float};
    const bool shaded = frame.view == View::shaded;
    switch (frame.format) {
    case PixelFormat::rgba8_srgb:
        output.write = shaded ? write_srgb_rgba : write_plain_rgba;
        return output;
    case PixelFormat::bgra8_srgb:
        output.write = shaded ? write_srgb_bgra : write_plain_bgra;
        return output;
    case PixelFormat::rgba16f:
        output.write = write_half;
        break;
    case PixelFormat::rgba32f:
        break;
    }
    if (shaded && frame.tone_mapping == ToneMapping::filmic) output.map_tones = map_filmic;
    if (shaded && frame.tone_mapping == ToneMapping::clamp) output.map_tones = map_clamp;
    return output;
}

} // namespace peregrine::render
