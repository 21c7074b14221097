#pragma once

#include "base/memory.h"
#include "math/vec.h"

#include <array>
#include <cstdint>
#include <memory>

namespace peregrine::scene {

// A mesh as the host described it, checked and copied; immutable, shared by the snapshots that show
// it. Optional arrays are empty.
struct MeshData {
    explicit MeshData(base::Memory* memory)
        : positions(memory), normals(memory), tangents(memory), texcoords(memory),
          texcoords1(memory), triangles(memory), materials(memory) {}

    struct MaterialRef {
        uint32_t index = 0;
        uint32_t generation = 0;
    };

    base::Vector<math::Vec3> positions;
    base::Vector<math::Vec3> normals;
    base::Vector<math::Vec4> tangents;
    base::Vector<math::Vec2> texcoords;
    base::Vector<math::Vec2> texcoords1;
    base::Vector<std::array<uint32_t, 3>> triangles; // vertex indices
    base::Vector<MaterialRef> materials;             // one a triangle, or empty
    MaterialRef material;                            // of triangles without one
};

} // namespace peregrine::scene
