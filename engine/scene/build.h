#pragma once

#include "scene/scene.h"

namespace peregrine::scene {

// The structure over the triangles that `geometry` has collected.
void build_structure(const BuildChoice& choice, base::Scheduler& scheduler,
                     const base::Progress& progress, base::Memory* memory, Geometry& geometry);

} // namespace peregrine::scene
