#pragma once

#include "base/memory.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <memory>

namespace peregrine::scene {

// What stays of a mesh when its vertices move. Optional arrays are empty.
struct MeshSurface {
    explicit MeshSurface(base::Memory* memory)
        : triangles(memory), texcoords(memory), texcoords1(memory), materials(memory) {}

    struct MaterialRef {
        uint32_t index = 0;
        uint32_t generation = 0;
    };

    base::Vector<std::array<uint32_t, 3>> triangles; // vertex indices
    base::Vector<math::Vec2> texcoords;
    base::Vector<math::Vec2> texcoords1;
    base::Vector<MaterialRef> materials; // one a triangle, or empty
    MaterialRef material;                // of triangles without one
};

// A mesh as the host described it, checked and copied; immutable, shared by the snapshots that show
// it. Optional arrays are empty.
struct MeshData {
    MeshData(std::shared_ptr<const MeshSurface> surface_, base::Memory* memory)
        : surface(std::move(surface_)), positions(memory), normals(memory), tangents(memory) {}

    std::shared_ptr<const MeshSurface> surface; // never null
    base::Vector<math::Vec3> positions;
    base::Vector<math::Vec3> normals;
    base::Vector<math::Vec4> tangents;

    const base::Vector<std::array<uint32_t, 3>>& triangles() const { return surface->triangles; }
};

// How a mesh may change: not at all, vertex by vertex, or as a whole.
enum class MeshKind : uint32_t { fixed = 0, deforming = 1, rigid = 2 };

} // namespace peregrine::scene
