#pragma once

#include "render/frame.h"

namespace peregrine::render {

// How many lux, more or less, nobody sees in the frame: they change no display value by more than
// approximations.least_light steps, of surfaces whose textures are not brighter than white.
float unseen_light(const scene::Snapshot& snapshot, const Frame& frame);

} // namespace peregrine::render
