#pragma once

#include "scene/geometry.h"
#include "scene/material_set.h"
#include "scene/mesh.h"

#include <cstdint>

namespace peregrine::scene {

inline constexpr uint64_t kMostTriangles = uint64_t(1) << 27; // under one structure

// What triangles of the material say of it: geometry::TriangleFlag bits.
uint32_t flags_of(const Material& material);

// The triangles of a mesh, in order, as those of slot `slot`, without those that are degenerate or
// not finite, which are counted.
void collect_triangles(const MeshData& data, const MeshMaterials& shown,
                       const MaterialSet& materials, uint32_t slot, Geometry& geometry);

} // namespace peregrine::scene
