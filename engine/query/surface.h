#pragma once

#include "scene/snapshot.h"

#include <cmath>

namespace peregrine::query {

// In double: the sides of a triangle may be 1e30.
inline math::Vec3d unit(const math::Vec3d& v) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > 0 ? v / length : math::Vec3d(0);
}

// Of the counter-clockwise side.
inline math::Vec3 geometric_normal(const scene::MeshData& mesh, uint32_t triangle) {
    const auto& corners = mesh.triangles[triangle];
    const math::Vec3d v0 = mesh.positions[corners[0]];
    const math::Vec3d v1 = mesh.positions[corners[1]];
    const math::Vec3d v2 = mesh.positions[corners[2]];
    return math::Vec3(unit(glm::cross(v1 - v0, v2 - v0)));
}

// Values at the corners of a triangle, blended at (u, v).
template <class Wide, class Values>
Wide blend(const Values& values, const std::array<uint32_t, 3>& corners, float u, float v) {
    const double weights[3] = {1.0 - double(u) - double(v), double(u), double(v)};
    Wide sum(0);
    for (size_t k = 0; k < 3; ++k) sum += weights[k] * Wide(values[corners[k]]);
    return sum;
}

// Interpolated where the mesh has normals, without normal map.
inline math::Vec3 shading_normal(const scene::MeshData& mesh, uint32_t triangle, float u, float v) {
    if (!mesh.normals.empty()) {
        const math::Vec3d normal =
            unit(blend<math::Vec3d>(mesh.normals, mesh.triangles[triangle], u, v));
        if (normal != math::Vec3d(0)) return math::Vec3(normal);
    }
    return geometric_normal(mesh, triangle);
}

} // namespace peregrine::query
