#include "render/post/tones.h"

#include "render/post/display_curve.h"

namespace peregrine::render::post {
namespace {

void map_filmic(const Plan& plan, TileBuffers& buffers) {
    // Beyond 1e9 the curve is flat; infinity would give NaN.
    for (float* channel : buffers.colors.channel)
        for (uint32_t i = 0; i < buffers.tile.count; ++i) {
            const float x = channel[i] * plan.frame.exposure;
            channel[i] = clamp01(filmic_tone(x < 1e9f ? x : 1e9f));
        }
}

void map_clamp(const Plan& plan, TileBuffers& buffers) {
    for (float* channel : buffers.colors.channel)
        for (uint32_t i = 0; i < buffers.tile.count; ++i)
            channel[i] = clamp01(channel[i] * plan.frame.exposure);
}

} // namespace

Stage tones_of(const Frame& frame) {
    const bool is_float =
        frame.format == PixelFormat::rgba16f || frame.format == PixelFormat::rgba32f;
    if (frame.view != View::shaded || !is_float) return nullptr;
    switch (frame.tone_mapping) {
    case ToneMapping::filmic:
        return map_filmic;
    case ToneMapping::clamp:
        return map_clamp;
    default:
        return nullptr;
    }
}

} // namespace peregrine::render::post
