#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "primitive.h"
#include "skin.h"

namespace host::gltf {

// Moves a primitive from the space of its mesh to the world. A mirroring transform turns the
// triangles and the tangents' handedness round, so that front faces stay counter-clockwise.
void place_rigid(Primitive& primitive, const glm::dmat4& world);

// Moves each vertex by its blend of joints: world transforms times inverse bind matrices. By glTF
// 2.0, 3.7.3.1 the transform of the node that has the mesh plays no part. `otherwise` is for
// vertices without weights.
void place_skinned(Primitive& primitive, const Influences& influences,
                   std::span<const glm::dmat4> joints, const glm::dmat4& otherwise);

// Makes clockwise triangles counter-clockwise.
void turn_round(std::vector<uint32_t>& indices);

} // namespace host::gltf
