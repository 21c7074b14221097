#pragma once

#include "render/frame.h"

#include <cstdint>

// What passes compare, average and enlarge are colours as they will be shown: square roots of
// display values, of which equal steps look about alike, in [0, 1]. Of frames without tone mapping,
// x / (1 + x) is taken for the display value of x = radiance * exposure.
namespace peregrine::render::post {

// Writes a part of a row of the host's image.
void write_shown(const Frame& frame, uint32_t x, uint32_t y, uint32_t count,
                 const float* const shown[3]);

} // namespace peregrine::render::post
