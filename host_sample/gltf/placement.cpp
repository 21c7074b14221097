#include "placement.h"

#include <cmath>

namespace host::gltf {

namespace {

// Normals go by the inverse transpose. The cofactor matrix is that, times the determinant, and
// exists for flattening transforms too.
struct Transform {
    glm::dmat4 point;
    glm::dmat3 normal;
    bool mirrors;

    explicit Transform(const glm::dmat4& matrix) : point(matrix) {
        const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
        mirrors = glm::dot(glm::cross(x, y), z) < 0.0;
        normal = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
        if (mirrors) normal = -normal;
    }
};

glm::vec3 to_unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    // Zero stands for "unusable"; the importer replaces such normals by the face's.
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

void place_vertex(Primitive& primitive, size_t i, const Transform& transform) {
    primitive.positions[i] =
        glm::vec3(transform.point * glm::dvec4(glm::dvec3(primitive.positions[i]), 1.0));
    if (!primitive.normals.empty())
        primitive.normals[i] = to_unit(transform.normal * glm::dvec3(primitive.normals[i]));
    if (primitive.tangents.empty()) return;
    const glm::vec4 tangent = primitive.tangents[i];
    const glm::vec3 direction =
        to_unit(glm::dmat3(transform.point) * glm::dvec3(glm::vec3(tangent)));
    const bool left_handed = (tangent.w < 0.0f) != transform.mirrors;
    primitive.tangents[i] = glm::vec4(direction, left_handed ? -1.0f : 1.0f);
}

glm::dmat4 blend(const Influences& influences, std::span<const glm::dmat4> joints, size_t vertex,
                 const glm::dmat4& otherwise) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (uint32_t i = influences.first[vertex]; i < influences.first[vertex + 1]; ++i) {
        const auto weight = static_cast<double>(influences.list[i].weight);
        sum += weight * joints[influences.list[i].joint];
        total += weight;
    }
    return total > 0.0 ? sum / total : otherwise;
}

} // namespace

void turn_round(std::vector<uint32_t>& indices) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

void place_rigid(Primitive& primitive, const glm::dmat4& world) {
    const Transform transform(world);
    for (size_t i = 0; i < primitive.positions.size(); ++i) place_vertex(primitive, i, transform);
    if (transform.mirrors) turn_round(primitive.indices);
}

void place_skinned(Primitive& primitive, const Influences& influences,
                   std::span<const glm::dmat4> joints, const glm::dmat4& otherwise) {
    size_t mirrored = 0;
    for (size_t i = 0; i < primitive.positions.size(); ++i) {
        const Transform transform(blend(influences, joints, i, otherwise));
        place_vertex(primitive, i, transform);
        mirrored += transform.mirrors ? 1 : 0;
    }
    if (2 * mirrored > primitive.positions.size()) turn_round(primitive.indices);
}

} // namespace host::gltf
