#pragma once

#include "scene/snapshot.h"

namespace peregrine::scene {

// The triangles of all meshes of a snapshot whose meshes and materials are filled in, in order of
// (mesh, primitive), without those that are degenerate or not finite, which are counted.
void collect_triangles(const Snapshot& snapshot, Geometry& geometry);

} // namespace peregrine::scene
