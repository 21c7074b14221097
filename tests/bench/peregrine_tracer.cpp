#include "peregrine_tracer.h"

#include "isa_name.h"
#include "peregrine_modes.h"

#include <map>
#include <stdexcept>

namespace peregrine::bench {
namespace {

rt_commit_desc to_commit(const TracerChoice& choice) {
    static const std::map<std::string, rt_structure> structures = {{"auto", RT_STRUCTURE_AUTO},
                                                                   {"bvh", RT_STRUCTURE_BVH},
                                                                   {"kdtree", RT_STRUCTURE_KDTREE},
                                                                   {"bih", RT_STRUCTURE_BIH}};
    static const std::map<std::string, rt_build_quality> qualities = {
        {"balanced", RT_BUILD_BALANCED}, {"fast", RT_BUILD_FAST}, {"best", RT_BUILD_BEST}};
    rt_commit_desc commit = rt_default_commit_desc();
    commit.structure = structures.at(choice.structure);
    commit.quality = qualities.at(choice.build);
    commit.memory = choice.compact ? RT_MEMORY_COMPACT : RT_MEMORY_FULL;
    return commit;
}

class PeregrineTracer : public Tracer {
public:
    PeregrineTracer(const rt_api& api, std::span<const geometry::Triangle> triangles,
                    const TracerChoice& choice)
        : api_(api), name_(choice.name) {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.isa = to_isa(choice.isa);
        desc.worker_count = choice.threads;
        const rt_commit_desc commit = to_commit(choice);
        check(api_.create_scene(&desc, &scene_));
        try {
            build(triangles, commit);
        } catch (...) {
            api_.destroy_scene(scene_);
            throw;
        }
    }
    ~PeregrineTracer() override { api_.destroy_scene(scene_); }
    PeregrineTracer(const PeregrineTracer&) = delete;
    PeregrineTracer& operator=(const PeregrineTracer&) = delete;

    std::string name() const override { return name_; }
    size_t mode_count() const override { return door_modes().size(); }
    std::string mode_name(size_t mode) const override { return door_modes()[mode].name; }
    bool suits(size_t mode, const RaySet& set) const override {
        return door_modes()[mode].suits(set);
    }
    bool is_parallel(size_t mode) const override { return door_modes()[mode].parallel; }

    void prepare(const RaySet& set, Results& results) const override {
        const size_t count = set.rays.size();
        if (set.any) {
            results.occluded.resize(count);
        } else {
            results.hits.resize(count);
            results.t.resize(count);
            results.triangle.resize(count);
            results.meshes.resize(count);
        }
    }

    void trace(size_t mode, const RaySet& set, size_t first, size_t count,
               Results& results) const override {
        door_modes()[mode].trace({api_, scene_, set, first, count, results});
    }

    Answer answer(size_t mode, const RaySet& set, const Results& results,
                  size_t ray) const override {
        return door_modes()[mode].answer(set, results, ray);
    }

private:
    void build(std::span<const geometry::Triangle> triangles, const rt_commit_desc& commit) {
        std::vector<math::Vec3> corners;
        for (const geometry::Triangle& triangle : triangles)
            corners.insert(corners.end(), {triangle.v0, triangle.v1, triangle.v2});
        rt_mesh_desc mesh = rt_default_mesh_desc();
        mesh.index_type = RT_INDEX_NONE;
        mesh.positions = {corners.data(), corners.size(), 0, 0};
        rt_mesh handle;
        check(api_.add_static_mesh(scene_, &mesh, &handle));
        rt_commit_report report = rt_default_commit_report();
        check(api_.commit_scene(scene_, &commit, &report));
        build_ms_ = report.build_ms;
        const uint64_t bytes =
            report.bytes_triangles + report.bytes_nodes + report.bytes_references;
        bytes_per_triangle_ = double(bytes) / double(triangles.size());
    }

    void check(rt_result result) const {
        if (result != RT_OK) throw std::runtime_error(api_.get_last_error());
    }

    const rt_api& api_;
    std::string name_;
    rt_scene scene_{};
};

} // namespace

std::unique_ptr<Tracer> make_peregrine_tracer(const rt_api& api,
                                              std::span<const geometry::Triangle> triangles,
                                              const TracerChoice& choice) {
    return std::make_unique<PeregrineTracer>(api, triangles, choice);
}

} // namespace peregrine::bench
