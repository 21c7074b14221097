#pragma once

#include "scene/material_set.h"

namespace peregrine::scene {

// Boxes about those triangles of a mesh that light may pass, in its own space: a few that lie
// apart, so that a window does not make a level of them.
void add_light_passing(const MaterialSet& set, const MeshMaterials& shown, const MeshData& mesh,
                       base::Vector<math::Box>& boxes);

// Of all a snapshot has; beyond so many the last one grows.
inline constexpr uint32_t kMostLightPassing = 64;
void add_light_passing(const math::Box& box, base::Vector<math::Box>& boxes);

} // namespace peregrine::scene
