#pragma once

#include <span>

#include "rig.h"

namespace host {

// The vertices of a deforming mesh in a pose. Normals and tangents are as long as the mesh's.
struct Shape {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
};

// The transform of a vertex: linear blend skinning (Magnenat-Thalmann et al. 1988). `joints` has a
// matrix for each joint of the mesh.
glm::mat4x3 blend_joints(const DeformingMesh& mesh, std::span<const glm::mat4x3> joints,
                         size_t vertex);

// Morphs by the weights, as many as are both given and known, then skins.
void deform(const DeformingMesh& mesh, std::span<const glm::mat4x3> joints,
            std::span<const double> weights, Shape& out);

} // namespace host
