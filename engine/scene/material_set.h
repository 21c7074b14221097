#pragma once

#include "base/memory.h"
#include "math/box.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/program.h"
#include "scene/texture.h"

#include <cstdint>
#include <memory>

namespace peregrine::scene {

// The materials of a scene with their textures found; shared by snapshots between which none of
// them changed.
struct MaterialSet {
    explicit MaterialSet(base::Memory* memory)
        : materials(memory), textures(memory), programs(memory) {}

    base::Vector<Material> materials;                      // 0 is the default one, slot i at i + 1
    base::Vector<std::shared_ptr<const Texture>> textures; // keeps those of the materials alive
    base::Vector<HostProgram> programs; // 0 is none, slot i at i + 1; empty if the scene has none
};

// What a mesh shows of them; shared likewise.
struct MeshMaterials {
    explicit MeshMaterials(base::Memory* memory) : each(memory), light_passing(memory) {}

    base::Vector<uint32_t> each; // per triangle: index in MaterialSet::materials; or empty
    uint32_t all = 0;            // of all triangles if `each` is empty
    uint32_t features = 0;       // Feature bits of those that are shown
    base::Vector<math::Box> light_passing; // of a fixed mesh: see add_light_passing

    uint32_t of(uint32_t primitive) const { return each.empty() ? all : each[primitive]; }
};

} // namespace peregrine::scene
