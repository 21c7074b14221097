#pragma once

#include "effects/effects.h"
#include "stage.h"

namespace host {

inline constexpr float occlusion_range = 1.2f; // metres, of rich effects

// For the picture alone; particles are the caller's.
inline void choose(Effects effects, Frame& frame) {
    if (effects == Effects::plain) return;
    frame.bloom = 0.25f;
    if (effects != Effects::rich) return;
    frame.occlusion_range = occlusion_range;
    frame.airlight_shadows = 8;
}

} // namespace host
