#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "accessor.h"
#include "node_tree.h"
#include "primitive.h"

namespace host::gltf {

// Moves a primitive from the space of its mesh to the world. A mirroring transform turns the
// triangles and the tangents' handedness round, so that front faces stay counter-clockwise.
void place_rigid(Primitive& primitive, const glm::dmat4& world);

// The matrices of a skin's joints at rest: world transform times inverse bind matrix. By glTF 2.0,
// 3.7.3.1 the transform of the node that has the mesh plays no part. Throws InputError.
std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, Accessors& accessors,
                                       const NodeTree& tree, int skin);

// Moves each vertex by its blend of joints. False, and nothing is moved, if the primitive has no
// JOINTS_0 and WEIGHTS_0. Throws InputError for a joint that the skin does not have.
bool place_skinned(Primitive& primitive, Accessors& accessors, const tinygltf::Primitive& source,
                   const std::vector<glm::dmat4>& joints);

} // namespace host::gltf
