#pragma once

#include "scene/scene.h"

namespace peregrine::scene {

// One commit of a scene: fills a snapshot and remembers in the scene what the next one need not
// do again. Whatever fails leaves the scene as it was, but for work that need not be repeated.
class Commit {
public:
    Commit(Scene& scene, const CommitOptions& options, Snapshot& snapshot)
        : scene_(scene), options_(options), snapshot_(snapshot) {}

    void prepare();           // may fail
    void remember() noexcept; // what was built is the scene's
    CommitReport report();

private:
    using GeometryPointer = std::shared_ptr<const Geometry>;

    void show_materials();
    void show_meshes();
    void show_lights();
    void build_parts();
    void build_shapes();
    void place_instances();
    void find_bounds();
    void count(const MeshDescription& mesh, CommitReport& report) const;
    GeometryPointer build(MeshKind kind, const BuildChoice& choice, const base::Progress& progress);
    bool shows(const MeshDescription& mesh, MeshKind kind) const {
        return mesh.kind == kind && !mesh.hidden;
    }
    trace::Part part_of(const Geometry& geometry, uint64_t first) const;

    Scene& scene_;
    const CommitOptions& options_;
    Snapshot& snapshot_;
};

} // namespace peregrine::scene
