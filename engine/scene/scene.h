#pragma once

#include "accel/bvh/builder.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "base/slot_map.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/snapshot.h"
#include "scene/snapshot_store.h"
#include "scene/texture.h"
#include "trace/kernels.h"

#include <memory>

namespace peregrine::scene {

using base::Handle;

// What the host described. Changing it changes no snapshot until the next commit.
struct MeshDescription {
    std::shared_ptr<const MeshData> data;
    uint32_t layer_mask = ~0u;
    bool dynamic = false;
    uint64_t user_data = 0;
};

// A material whose textures are still handles: commit resolves them.
struct MaterialDescription {
    Material material;
    Handle base_color_texture;
    Handle normal_texture;
    Handle emissive_texture;
};

// How to build the structure over the triangles.
struct BuildChoice {
    trace::Structure structure = trace::Structure::bvh;
    accel::bvh::Quality quality = accel::bvh::Quality::balanced;
    float empty_bonus = 0; // of the kd-tree

    // Without what the structure ignores: equal ones build the same.
    BuildChoice relevant() const;

    bool operator==(const BuildChoice&) const = default;
};

struct CommitOptions {
    BuildChoice build;
    base::Progress progress;
};

struct CommitReport {
    std::shared_ptr<const Geometry> geometry; // for its tree's report
    BuildChoice build;
    uint32_t features = 0;
    uint64_t bytes_attributes = 0;
    uint64_t bytes_textures = 0;
    uint32_t light_count = 0;
    bool rebuilt = false;
    double commit_ms = 0;
};

struct SceneOptions {
    base::HostMemory::Functions memory;
    base::HostScheduler host_scheduler;
    uint32_t worker_count = 1;
    base::Isa isa = base::Isa::best;
};

// One thread at a time describes and commits; any thread pins snapshots.
class Scene {
public:
    explicit Scene(const SceneOptions& options);

private:
    const uint32_t first_generation_;

public:
    // In front of all that it serves, so that it goes last.
    base::HostMemory memory;
    base::Scheduler scheduler;

    base::SlotMap<std::shared_ptr<const Texture>> textures;
    base::SlotMap<MaterialDescription> materials;
    base::SlotMap<MeshDescription> meshes;
    base::SlotMap<Light> lights;
    Environment environment;
    SnapshotStore snapshots;

    // To be called when a mesh was added, removed or updated, or when a material became masked or
    // double-sided or ceased to be: the next commit rebuilds the structure.
    void touch_geometry() { geometry_changed_ = true; }

    CommitReport commit(const CommitOptions& options);
    uint64_t version() const { return version_; }
    base::Isa isa() const { return isa_; }

private:
    std::shared_ptr<const Geometry> current_geometry(const Snapshot& snapshot,
                                                     const CommitOptions& options);

    base::Isa isa_; // never `best`
    std::shared_ptr<const Geometry> geometry_;
    BuildChoice geometry_build_; // what is relevant of it
    bool geometry_changed_ = true;
    uint64_t version_ = 0;
};

} // namespace peregrine::scene
