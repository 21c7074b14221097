#pragma once

#include "scene/scene.h"

namespace peregrine::scene {

// Copies what `scene` describes into a new snapshot, with handles resolved to places in it. Throws
// base::Error invalid_argument if a material names a texture that was removed.
void resolve(Scene& scene, Snapshot& snapshot);

} // namespace peregrine::scene
