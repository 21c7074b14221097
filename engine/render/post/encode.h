#pragma once

#include "render/plan.h"
#include "render/tile_buffers.h"

namespace peregrine::render::post {

// The stage that writes the tile's colours to the host's image.
Stage encoder_of(const Frame& frame);

} // namespace peregrine::render::post
