#pragma once

#include "render/film.h"
#include "render/plan.h"

#include <cstdint>

namespace peregrine::render::post {

// Enlarging along edges, after the idea of FidelityFX Super Resolution's EASU (Lottes 2021): each
// pixel is a mean of the 12 traced ones about it, with weights that fall with the distance, and
// distances along an edge count less. Here the edge is that of the structure tensor (Bigun and
// Granlund 1987), the weights are enlarge-inl.h's.
uint32_t enlarged_block_count(const Frame& frame);

// Writes a block of the frame's image from the plan's film.
void enlarge_block(const Plan& plan, uint32_t block);

} // namespace peregrine::render::post
