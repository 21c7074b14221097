#include "skinning.h"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

// Zero, which the engine replaces by the face's own normal, where there is no direction.
glm::vec3 to_unit(const glm::vec3& v) {
    const float length = std::sqrt(glm::dot(v, v));
    return length > 0.0f && std::isfinite(length) ? v / length : glm::vec3(0.0f);
}

// A tangent's w, the handedness, is not morphed.
template <class T>
void add_deltas(std::vector<T>& values, const std::vector<glm::vec3>& deltas, float weight) {
    if (deltas.empty()) return;
    for (size_t i = 0; i < values.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) values[i][axis] += weight * deltas[i][axis];
}

void morph(const DeformingMesh& mesh, std::span<const double> weights, Shape& shape) {
    shape.positions = mesh.mesh.positions;
    shape.normals = mesh.mesh.normals;
    shape.tangents = mesh.mesh.tangents;
    for (size_t i = 0; i < std::min(weights.size(), mesh.targets.size()); ++i) {
        const auto weight = static_cast<float>(weights[i]);
        if (weight == 0.0f) continue;
        add_deltas(shape.positions, mesh.targets[i].positions, weight);
        add_deltas(shape.normals, mesh.targets[i].normals, weight);
        add_deltas(shape.tangents, mesh.targets[i].tangents, weight);
    }
}

// Normals go by the cofactors: the inverse transpose times the determinant, without a division.
glm::vec3 turn_normal(const glm::mat4x3& matrix, const glm::vec3& normal) {
    const glm::vec3 yz = glm::cross(matrix[1], matrix[2]);
    const glm::vec3 turned = yz * normal.x + glm::cross(matrix[2], matrix[0]) * normal.y
                             + glm::cross(matrix[0], matrix[1]) * normal.z;
    return to_unit(glm::dot(matrix[0], yz) < 0.0f ? -turned : turned);
}

} // namespace

glm::mat4x3 blend_joints(const DeformingMesh& mesh, std::span<const glm::mat4x3> joints,
                         size_t vertex) {
    const uint32_t first = mesh.first_influence[vertex], end = mesh.first_influence[vertex + 1];
    if (first == end) return glm::mat4x3(1.0f);
    if (end - first == 1) return joints[mesh.influences[first].joint];
    glm::mat4x3 sum(0.0f);
    for (uint32_t i = first; i < end; ++i) {
        const Influence& influence = mesh.influences[i];
        for (int column = 0; column < 4; ++column)
            sum[column] += influence.weight * joints[influence.joint][column];
    }
    return sum;
}

void deform(const DeformingMesh& mesh, std::span<const glm::mat4x3> joints,
            std::span<const double> weights, Shape& out) {
    morph(mesh, weights, out);
    for (size_t i = 0; i < out.positions.size(); ++i) {
        const glm::mat4x3 matrix = blend_joints(mesh, joints, i);
        const glm::vec3 p = out.positions[i];
        out.positions[i] = matrix[0] * p.x + matrix[1] * p.y + matrix[2] * p.z + matrix[3];
        if (!out.normals.empty()) out.normals[i] = turn_normal(matrix, out.normals[i]);
        if (out.tangents.empty()) continue;
        const glm::vec4 t = out.tangents[i];
        out.tangents[i] =
            glm::vec4(to_unit(matrix[0] * t.x + matrix[1] * t.y + matrix[2] * t.z), t.w);
    }
}

} // namespace host
