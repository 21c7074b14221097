#pragma once

#include "accel/bvh/builder.h"
#include "accel/instances/builder.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/recycling_memory.h"
#include "base/scheduler.h"
#include "base/slot_map.h"
#include "scene/fog.h"
#include "scene/light.h"
#include "scene/light_map.h"
#include "scene/light_proofs.h"
#include "scene/light_view.h"
#include "scene/lights/light_set.h"
#include "scene/material.h"
#include "scene/mesh.h"
#include "scene/program.h"
#include "scene/snapshot.h"
#include "scene/snapshot_store.h"
#include "scene/texture.h"
#include "trace/kernels.h"

#include <memory>
#include <mutex>
#include <optional>

namespace peregrine::scene {

using base::Handle;

// What the last commit made of a mesh's materials.
struct ShownMaterials {
    std::shared_ptr<const MeshMaterials> materials;
    uint64_t version = 0; // of Scene::materials_version_
};

// The triangles of a mesh that moves, in its own space, built by the first commit that shows them;
// shared by instances of a rigid mesh, built again after each update of a deforming one.
struct Shape {
    ShownMaterials shown;
    std::shared_ptr<const Geometry> geometry; // null: yet to be built
    uint64_t flags_version = 0;               // Scene::flags_version_ that it was built with
    uint64_t awaited_by = 0;                  // the last commit that wanted it built, ...
    uint64_t counted_by = 0;                  // ... that counted it: of commits_begun_
};

// What the host described. Changing it changes no snapshot until the next commit.
struct MeshDescription {
    std::shared_ptr<const MeshData> data;
    uint32_t layer_mask = ~0u;
    MeshKind kind = MeshKind::fixed;
    uint64_t user_data = 0;
    bool hidden = false;
    std::shared_ptr<Shape> shape = {}; // unless it is fixed
    math::Affine transform = {};       // where a rigid mesh stands: absolute, ...
    Placement placement = {};          // ... and relative to Scene::origin()

    // What commits found out and keep until it changes.
    ShownMaterials shown = {};            // of a mesh without a shape
    accel::instances::Extent extent = {}; // of a mesh with one
    bool extent_is_known = false;

    void stand(const math::Affine& at, const math::Vec3d& origin) {
        transform = at;
        placement = place(at, origin);
        extent_is_known = false;
    }
};

// A material whose textures and program are still handles: commit resolves them.
struct MaterialDescription {
    Material material;
    Handle base_color_texture;
    Handle normal_texture;
    Handle emissive_texture;
    Handle program = {};
    Handle occlusion_texture = {};
    Handle roughness_texture = {};
};

// How to build the structure over the fixed meshes.
struct BuildChoice {
    trace::Structure structure = trace::Structure::bvh;
    accel::bvh::Quality quality = accel::bvh::Quality::balanced;
    float empty_bonus = 0; // of the kd-tree
    bool compact = false;  // of the BVH

    // Without what the structure ignores: equal ones build the same.
    BuildChoice relevant() const;

    bool operator==(const BuildChoice&) const = default;
};

struct CommitOptions {
    BuildChoice build;
    base::Progress progress;
    ProofChoice proofs;
};

struct CommitReport {
    std::shared_ptr<const Geometry> fixed; // for its tree's report
    BuildChoice build;
    uint32_t features = 0;
    uint64_t rigid_triangles = 0; // instances of a mesh count once, here and below
    uint64_t deforming_triangles = 0;
    uint64_t shape_bytes = 0;      // of the triangles and nodes of both
    double deforming_build_ms = 0; // of all, whenever each was built
    uint64_t degenerate_count = 0; // of all kinds, and so ...
    uint64_t non_finite_count = 0;
    uint64_t bytes_attributes = 0;
    uint64_t bytes_textures = 0;
    uint32_t instance_count = 0;
    uint32_t light_count = 0;
    bool fixed_rebuilt = false;
    bool deforming_rebuilt = false;
    ProofReport proofs;
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
    base::RecyclingMemory recycled;     // for what commits and updates make again and again, ...
    base::RecyclingMemory frame_memory; // ... and for frames: as much as the last ones needed
    base::Scheduler scheduler;

    base::SlotMap<std::shared_ptr<const Texture>> textures;
    base::SlotMap<HostProgram> programs; // those of materials are there
    base::SlotMap<MaterialDescription> materials;
    base::SlotMap<MeshDescription> meshes;
    base::SlotMap<Light> lights;
    Environment environment; // its sky's texture is a handle still
    Handle sky_texture;
    Fog fog;
    SnapshotStore snapshots;

    // What snapshots are relative to from the next commit on. Fixed and deforming meshes already
    // are.
    void set_origin(const math::Vec3d& origin);
    const math::Vec3d& origin() const { return origin_; }

    // To be called when meshes of a kind came or went: the next commit builds the structure of the
    // fixed ones anew. Others have their own.
    void touch_triangles(MeshKind kind) {
        if (kind == MeshKind::fixed) fixed_changed_ = true;
    }
    // ... when a material or a texture changed in any way.
    void touch_materials() { ++materials_version_; }
    // ... when flags_of() a material changed: triangles carry them.
    void touch_flags();

    // What the next commits show, as long as the fixed meshes stay as they are. Any thread.
    void set_light_map(std::shared_ptr<const LightMap> map);

    CommitReport commit(const CommitOptions& options);
    uint64_t version() const { return version_; }
    base::Isa isa() const { return isa_; }

private:
    friend class Commit;
    using Extents = base::Vector<accel::instances::Extent>;

    base::Isa isa_; // never `best`
    math::Vec3d origin_{0};
    std::shared_ptr<const Geometry> fixed_;
    std::shared_ptr<const MaterialSet> material_set_;
    BuildChoice fixed_build_; // what is relevant of it
    bool fixed_changed_ = true;
    uint64_t materials_version_ = 1;
    uint64_t material_set_version_ = 0; // of materials_version_ that material_set_ shows
    uint64_t flags_version_ = 1;
    uint64_t version_ = 0;
    uint64_t commits_begun_ = 0;
    base::Vector<LightView> views_;             // by slot of the light: what was proved of it
    std::optional<LightProofs> proofs_;         // that were begun
    std::shared_ptr<const LightSet> light_set_; // of the last commit
    std::mutex light_map_mutex_;
    std::shared_ptr<const LightMap> light_map_; // that was baked last
    Extents extents_;                           // room for commits to work in
    base::Vector<accel::instances::Place> places_;
};

} // namespace peregrine::scene
