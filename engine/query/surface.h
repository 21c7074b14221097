#pragma once

#include "scene/snapshot.h"

#include <cmath>

namespace peregrine::query {

// In double: the sides of a triangle may be 1e30.
inline math::Vec3d unit(const math::Vec3d& v) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > 0 ? v / length : math::Vec3d(0);
}

// Values at the corners of a triangle, blended at (u, v).
template <class Wide, class Values>
Wide blend(const Values& values, const std::array<uint32_t, 3>& corners, float u, float v) {
    const double weights[3] = {1.0 - double(u) - double(v), double(u), double(v)};
    Wide sum(0);
    for (size_t k = 0; k < 3; ++k) sum += weights[k] * Wide(values[corners[k]]);
    return sum;
}

// A mesh as it stands in the world; with its normals, which a placement turns by the inverse
// transpose, so that they stay on their side.
class PlacedMesh {
public:
    PlacedMesh(const scene::Snapshot& snapshot, const scene::Snapshot::Mesh& mesh)
        : data_(*mesh.data), placement_(snapshot.placement_of(mesh)) {}

    bool is_flat() const { return data_.normals.empty(); }

    math::Vec3d position(uint32_t triangle, float u, float v) const {
        const math::Vec3d p =
            blend<math::Vec3d>(data_.positions, data_.triangles()[triangle], u, v);
        return placement_ ? placement_->to_world.point(p) : p;
    }

    // Of the counter-clockwise side.
    math::Vec3 geometric_normal(uint32_t triangle) const {
        const auto& corners = data_.triangles()[triangle];
        const math::Vec3d v0 = data_.positions[corners[0]];
        const math::Vec3d v1 = data_.positions[corners[1]];
        const math::Vec3d v2 = data_.positions[corners[2]];
        return math::Vec3(turn(unit(glm::cross(v1 - v0, v2 - v0))));
    }

    // Interpolated where the mesh has normals, without normal map.
    math::Vec3 shading_normal(uint32_t triangle, float u, float v) const {
        if (!is_flat()) {
            const math::Vec3d normal =
                unit(blend<math::Vec3d>(data_.normals, data_.triangles()[triangle], u, v));
            if (normal != math::Vec3d(0)) return math::Vec3(turn(normal));
        }
        return geometric_normal(triangle);
    }

private:
    math::Vec3d turn(const math::Vec3d& normal) const {
        return placement_ ? unit(placement_->to_local.transposed(normal)) : normal;
    }

    const scene::MeshData& data_;
    const scene::Placement* placement_;
};

} // namespace peregrine::query
