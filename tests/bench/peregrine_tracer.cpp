#include "peregrine_tracer.h"

#include <map>
#include <stdexcept>

namespace peregrine::bench {
namespace {

// How rays are handed over.
enum class Form {
    single, // a call per ray
    batch,  // all that belong together in one call
};

bool for_all(const RaySet&) {
    return true;
}
bool for_batches(const RaySet& set) {
    return !set.one_by_one;
}

// A way through the door is a line here: what a query says beyond its rays goes into `configure`.
// Whole frames of visibility would be a form of their own, for sets with views.
struct Mode {
    const char* name;
    Form form;
    bool (*suits)(const RaySet&);
    void (*configure)(rt_query_desc&);
};
constexpr Mode kModes[] = {
    {"single", Form::single, for_all, [](rt_query_desc&) {}},
    {"batch", Form::batch, for_batches, [](rt_query_desc&) {}},
};

rt_isa to_isa(const std::string& name) {
    static const std::map<std::string, rt_isa> isas = {
        {"best", RT_ISA_BEST}, {"scalar", RT_ISA_SCALAR}, {"sse4", RT_ISA_SSE4},
        {"avx2", RT_ISA_AVX2}, {"avx512", RT_ISA_AVX512},
    };
    return isas.at(name);
}

rt_commit_desc to_commit(const TracerChoice& choice) {
    if (choice.structure != "auto" && choice.structure != "kdtree")
        throw std::runtime_error("--structure " + choice.structure
                                 + ": the engine's header has no choice of structure yet, and "
                                   "builds kd-trees");
    return rt_default_commit_desc();
}

class PeregrineTracer : public Tracer {
public:
    PeregrineTracer(const rt_api& api, std::span<const geometry::Triangle> triangles,
                    const TracerChoice& choice)
        : api_(api) {
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

    std::string name() const override { return "peregrine"; }
    size_t mode_count() const override { return std::size(kModes); }
    std::string mode_name(size_t mode) const override { return kModes[mode].name; }
    bool suits(size_t mode, const RaySet& set) const override { return kModes[mode].suits(set); }

    void prepare(const RaySet& set, Results& results) const override {
        if (set.any)
            results.occluded.resize(set.rays.size());
        else
            results.hits.resize(set.rays.size());
    }

    void trace(size_t mode, const RaySet& set, size_t first, size_t count,
               Results& results) const override {
        rt_query_desc query = rt_default_query_desc();
        kModes[mode].configure(query);
        query.kind = set.any ? RT_QUERY_ANY : RT_QUERY_CLOSEST;
        query.rays = reinterpret_cast<const rt_ray*>(set.rays.data() + first);
        query.ray_count = kModes[mode].form == Form::single ? 1 : count;
        query.hits = set.any ? nullptr : results.hits.data() + first;
        query.occluded = set.any ? results.occluded.data() + first : nullptr;
        for (size_t done = 0; done < count; done += query.ray_count) {
            check(api_.trace_query(scene_, &query));
            query.rays += query.ray_count;
            if (set.any)
                query.occluded += query.ray_count;
            else
                query.hits += query.ray_count;
        }
    }

    Answer answer(const RaySet& set, const Results& results, size_t ray) const override {
        if (set.any) return {0, results.occluded[ray] ? 0 : geometry::kNoTriangle};
        return {results.hits[ray].t, results.hits[ray].triangle};
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
    rt_scene scene_{};
};

} // namespace

std::unique_ptr<Tracer> make_peregrine_tracer(const rt_api& api,
                                              std::span<const geometry::Triangle> triangles,
                                              const TracerChoice& choice) {
    return std::make_unique<PeregrineTracer>(api, triangles, choice);
}

} // namespace peregrine::bench
