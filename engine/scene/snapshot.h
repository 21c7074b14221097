#pragma once

#include "base/memory.h"
#include "scene/features.h"
#include "scene/fog.h"
#include "scene/geometry.h"
#include "scene/light.h"
#include "scene/light_map.h"
#include "scene/lights/light_set.h"
#include "scene/material_set.h"
#include "scene/mesh.h"
#include "scene/placement.h"
#include "trace/world/world.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

namespace peregrine::scene {

struct Snapshot;

// Whose alpha an instance's test asks about.
struct InstanceAlpha {
    const Snapshot* snapshot;
    uint32_t mesh; // slot
};

// A frozen world: what queries and frames read. Never changes after its commit.
struct Snapshot {
    struct Mesh {
        std::shared_ptr<const MeshData> data; // null: the slot is free
        std::shared_ptr<const MeshMaterials> materials;
        std::shared_ptr<const Geometry> shape; // of a mesh that moves, in its own space
        uint32_t placement = kNotPlaced;       // of a rigid mesh: index in `placements`
        uint32_t generation = 0;
        uint64_t user_data = 0;

        static constexpr uint32_t kNotPlaced = ~0u;
    };

    explicit Snapshot(base::Memory* memory)
        : meshes(memory), layer_masks(memory), generations(memory), placements(memory),
          instances(memory), instance_nodes(memory), instance_rests(memory),
          instance_alphas(memory), light_passing(memory) {}

    const Material& material_of(const Mesh& mesh, uint32_t primitive) const {
        return material_set->materials[mesh.materials->of(primitive)];
    }
    // Null: its vertices are where they are.
    const Placement* placement_of(const Mesh& mesh) const {
        return mesh.placement == Mesh::kNotPlaced ? nullptr : &placements[mesh.placement];
    }
    base::Isa isa() const { return world.fixed.kernels->isa; }

    std::shared_ptr<const Geometry> fixed; // of all fixed meshes
    std::shared_ptr<const MaterialSet> material_set;
    std::shared_ptr<const LightSet> lights;
    std::shared_ptr<const LightMap> light_map; // of the fixed meshes; null: nothing was baked
    trace::World world;                        // into these and the shapes of the meshes
    base::Vector<Mesh> meshes;                 // by slot
    base::Vector<uint32_t> layer_masks;        // by slot, for the kernels
    base::Vector<uint32_t> generations;        // by slot, for hits
    base::Vector<Placement> placements;
    base::Vector<trace::Instance> instances; // of meshes that move and are not hidden
    base::Vector<accel::instances::Node> instance_nodes;
    base::Vector<accel::instances::NodeRest> instance_rests; // beside them, if any is far away
    base::Vector<InstanceAlpha> instance_alphas; // beside `instances`; empty if no test asks
    base::Vector<math::Box> light_passing;       // what light may pass lies in them
    Environment environment;
    Fog fog;
    uint32_t features = 0; // Feature bits that the scene has
    uint64_t version = 0;
    math::Vec3d origin{0};          // that everything above is relative to, and ...
    bool displaced = false;         // ... whether it is not (0, 0, 0)
    std::atomic<uint32_t> holds{0}; // handles of the host that keep it: the store's to count
};

} // namespace peregrine::scene
