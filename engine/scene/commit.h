#pragma once

#include "scene/scene.h"

#include <chrono>

namespace peregrine::scene {

// One commit of a scene: fills a snapshot and remembers in the scene what the next one need not
// do again. Whatever fails leaves the scene as it was, but for work that need not be repeated.
class Commit {
public:
    Commit(Scene& scene, const CommitOptions& options, Snapshot& snapshot)
        : scene_(scene), options_(options), snapshot_(snapshot), number_(++scene.commits_begun_),
          lights_(&scene.recycled), light_views_(&scene.recycled), views_(&scene.recycled),
          number_of_light_(&scene.recycled) {}

    void prepare();           // may fail
    void remember() noexcept; // what was built is the scene's
    CommitReport report();

private:
    using GeometryPointer = std::shared_ptr<const Geometry>;

    // A structure to be built: over all fixed meshes, or over one that moves.
    struct Work {
        MeshKind kind;
        Shape* shape;  // null: of the fixed ones
        uint32_t slot; // of the one that moves
        BuildChoice choice;
        uint64_t triangles;
    };
    using Works = base::Vector<Work>;

    void show_materials();
    void show_meshes();
    void show_lights();
    void show_environment();
    // Of the progress; the rest is that of proofs.
    float build_share() const { return options_.proofs.proves ? 0.1f : 1.0f; }
    void build_structures();
    Works find_works();
    uint64_t fixed_triangles() const;
    GeometryPointer build(const Work& work, base::Scheduler& scheduler,
                          const base::Progress& progress) const;
    void keep(const Work& work, GeometryPointer geometry);
    void build_small_ones(Works& works);
    void place_instances();
    void place_far_instances();
    void find_bounds();

    using AllCorners = base::Vector<trace::visibility::Corners>;
    using LightNumbers = base::Vector<uint32_t>;
    using WantedProofs = base::Vector<LightProofs::Wanted>;
    AllCorners fixed_corners() const;
    WantedProofs keep_proofs();
    void go_on_proving(const WantedProofs& wanted, std::chrono::steady_clock::time_point begin);
    void prove_lights();
    void share_lights();
    void show_light_map();

    void count(const MeshDescription& mesh, CommitReport& report) const;
    void count(const Geometry& shape, MeshKind kind, CommitReport& report) const;
    trace::Part part_of(const Geometry& geometry, uint64_t first) const;

    Scene& scene_;
    const CommitOptions& options_;
    Snapshot& snapshot_;
    const uint64_t number_;
    uint64_t unusable_ = 0;    // triangles of instances that are left out
    uint32_t moving_ = 0;      // meshes, hidden ones as well
    uint32_t rigid_count_ = 0; // instances
    bool deforming_built_ = false;
    base::Vector<Light> lights_;
    LightViews light_views_;        // beside them, as in LightSet
    base::Vector<LightView> views_; // by slot of the light
    LightNumbers number_of_light_;  // by slot: in the snapshot
    ProofReport proof_report_;
};

} // namespace peregrine::scene
