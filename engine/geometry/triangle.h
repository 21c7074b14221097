#pragma once

#include "math/box.h"
#include "math/vec.h"

#include <cstdint>

namespace peregrine::geometry {

using math::Box;
using math::Vec3;

enum TriangleFlag : uint32_t {
    kSingleSided = 1u << 0, // frames do not show its back
    kMasked = 1u << 1,      // it may be absent at a hit, or light may pass: ask the filter's test
};

// Where a triangle comes from.
struct TriangleInfo {
    uint32_t mesh;           // slot of the mesh in its scene
    uint32_t primitive : 30; // the host's own index in that mesh
    uint32_t flags : 2;      // TriangleFlag
};
static_assert(sizeof(TriangleInfo) == 8);

// What structures are built over. Lists of triangles ascend in (mesh, primitive), so that of two
// hits at the same t the one with the smaller index in the list comes first.
struct Triangle {
    Vec3 v0;
    uint32_t mesh; // slot of the mesh in its scene
    Vec3 v1;
    uint32_t primitive; // the host's own index in that mesh
    Vec3 v2;
    uint32_t flags; // TriangleFlag

    TriangleInfo info() const { return {mesh, primitive & 0x3fffffffu, flags & 3}; }
};
static_assert(sizeof(Triangle) == 48 && alignof(Triangle) == 4);

inline constexpr uint32_t kNoTriangle = 0xffffffffu;

inline Box bounds(const Triangle& triangle) {
    return {glm::min(glm::min(triangle.v0, triangle.v1), triangle.v2),
            glm::max(glm::max(triangle.v0, triangle.v1), triangle.v2)};
}

} // namespace peregrine::geometry
