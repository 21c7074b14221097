#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render::post {

inline float clamp01(float x) {
    return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
}

// The stage that maps radiance to display values; null if there is nothing to do: 8-bit images take
// their tones while they are encoded.
Stage tones_of(const Frame& frame);

} // namespace peregrine::render::post
