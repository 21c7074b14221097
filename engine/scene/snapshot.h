#pragma once

#include "accel/bih/tree.h"
#include "accel/bvh/tree.h"
#include "accel/kdtree/tree.h"
#include "base/memory.h"
#include "geometry/triangle.h"
#include "scene/features.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/texture.h"
#include "trace/kernels.h"

#include <cstdint>
#include <memory>

namespace peregrine::scene {

// The triangles of all meshes and the structure over them; shared by snapshots between which no
// mesh changed.
struct Geometry {
    explicit Geometry(base::Memory* memory)
        : infos(memory), triangles(memory), bvh(memory), kdtree(memory), bih(memory) {}

    trace::Structure structure = trace::Structure::bvh;
    base::Vector<geometry::TriangleInfo> infos;
    base::Vector<geometry::Triangle> triangles; // empty once a BVH has its own copy
    accel::bvh::Tree bvh;
    accel::kdtree::Tree kdtree;
    accel::bih::Tree bih;
    uint64_t degenerate_count = 0;
    uint64_t non_finite_count = 0;

    trace::Target target() const {
        return {infos.data(),         bounds(),
                bvh.nodes.data(),     bvh.blocks.data(),
                kdtree.nodes.data(),  kdtree.references.data(),
                triangles.data(),     bih.nodes.data(),
                bih.references.data()};
    }

private:
    const math::Box& bounds() const {
        switch (structure) {
        case trace::Structure::kdtree:
            return kdtree.bounds;
        case trace::Structure::bih:
            return bih.bounds;
        default:
            return bvh.bounds;
        }
    }
};

// A frozen world: what queries and frames read. Never changes after its commit.
struct Snapshot {
    struct Mesh {
        std::shared_ptr<const MeshData> data; // null: the slot is free
        base::Vector<uint32_t> materials; // per triangle: index in Snapshot::materials; or empty
        uint32_t material = 0;            // of all triangles if `materials` is empty
        uint32_t generation = 0;
        uint32_t layer_mask = ~0u;
        bool dynamic = false;
        uint64_t user_data = 0;

        uint32_t material_of(uint32_t primitive) const {
            return materials.empty() ? material : materials[primitive];
        }
    };

    explicit Snapshot(base::Memory* memory)
        : meshes(memory), layer_masks(memory), generations(memory), materials(memory),
          textures(memory), lights(memory) {}

    std::shared_ptr<const Geometry> geometry;
    trace::Target target{};                                // into `geometry`
    base::Vector<Mesh> meshes;                             // by slot
    base::Vector<uint32_t> layer_masks;                    // by slot, for the kernels
    base::Vector<uint32_t> generations;                    // by slot, for hits
    base::Vector<Material> materials;                      // 0 is the default material
    base::Vector<std::shared_ptr<const Texture>> textures; // keeps those of the materials alive
    base::Vector<Light> lights;
    Environment environment;
    uint32_t features = 0; // Feature bits that the scene has
    uint64_t version = 0;
    const trace::Kernels* kernels = nullptr;
};

} // namespace peregrine::scene
