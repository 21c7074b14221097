#include "commands.h"
#include "timing.h"

#include "plugin.h"
#include "support/world.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace peregrine::bench {
namespace {

constexpr size_t kRays = 512;
constexpr uint32_t kRounds = 40; // a pass

// One scene behind the door, with the triangles of a World.
class Door {
public:
    Door(const rt_api& api, const std::vector<geometry::Triangle>& triangles) : api_(api) {
        const rt_scene_desc desc = rt_default_scene_desc();
        require(api_.create_scene(&desc, &scene_));
        std::vector<math::Vec3> corners;
        for (const geometry::Triangle& triangle : triangles)
            corners.insert(corners.end(), {triangle.v0, triangle.v1, triangle.v2});
        rt_mesh_desc mesh = rt_default_mesh_desc();
        mesh.index_type = RT_INDEX_NONE;
        mesh.positions = {corners.data(), corners.size(), 0, 0};
        rt_mesh handle;
        require(api_.add_static_mesh(scene_, &mesh, &handle));
        require(api_.commit_scene(scene_, nullptr, nullptr));
        query_.ray_count = 1;
        query_.hits = &hit_;
        query_.occluded = &occluded_;
    }
    ~Door() { api_.destroy_scene(scene_); }
    Door(const Door&) = delete;
    Door& operator=(const Door&) = delete;

    float ask(rt_query_kind kind, const math::Ray& ray) {
        query_.kind = kind;
        query_.rays = reinterpret_cast<const rt_ray*>(&ray);
        require(api_.trace_query(scene_, &query_));
        return kind == RT_QUERY_CLOSEST ? hit_.t : float(occluded_);
    }

private:
    void require(rt_result result) const {
        if (result != RT_OK) throw std::runtime_error(api_.get_last_error());
    }

    const rt_api& api_;
    rt_scene scene_{};
    rt_query_desc query_ = rt_default_query_desc();
    rt_hit hit_{};
    uint8_t occluded_ = 0;
};

struct Bare {
    trace::Target target;
    trace::Filter filter;
    const trace::Kernels* kernels = trace::select_kernels(trace::Structure::bvh, base::Isa::best);

    float ask(rt_query_kind kind, const math::Ray& ray) const {
        return kind == RT_QUERY_CLOSEST ? kernels->closest(target, ray, filter).t
                                        : float(kernels->occluded(target, ray, filter));
    }
};

template <class Contestant>
double ns_a_ray(Contestant& contestant, rt_query_kind kind, const std::vector<math::Ray>& rays) {
    [[maybe_unused]] volatile float sink = 0;
    const double start = wall_seconds();
    for (const math::Ray& ray : rays) sink = contestant.ask(kind, ray);
    return 1e9 * (wall_seconds() - start) / double(rays.size());
}

// Rays that end where they begin, above the scene: the kernel has next to nothing to do, and what
// remains is the door.
std::vector<math::Ray> rays_outside(const math::Box& bounds) {
    const math::Vec3 above = bounds.upper + math::Vec3(1);
    return std::vector<math::Ray>(kRays, {above, 0, {0.1f, 1, 0.1f}, 10});
}

void measure(const std::string& scene, const test::RaySet& set, const Options& options, Door& door,
             Bare& bare, nlohmann::json& rows) {
    for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
        std::vector<double> bare_ns, door_ns, difference;
        for (uint32_t round = 0; round < kRounds * options.passes; ++round) {
            bare_ns.push_back(ns_a_ray(bare, kind, set.rays)); // in turns, on the same machine
            door_ns.push_back(ns_a_ray(door, kind, set.rays));
            difference.push_back(door_ns.back() - bare_ns.back());
        }
        const char* name = kind == RT_QUERY_CLOSEST ? "closest" : "any";
        std::printf("%-16s %-10s %-8s %10.1f %10.1f %12.1f\n", scene.c_str(), set.name.c_str(),
                    name, median(bare_ns), median(door_ns), median(difference));
        rows.push_back({{"scene", scene},
                        {"rays", set.name},
                        {"query", name},
                        {"kernel_ns", median(bare_ns)},
                        {"door_ns", median(door_ns)},
                        {"difference_ns", median(difference)}});
    }
}

} // namespace

std::string run_door(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const host::Plugin plugin(options.library);
    std::printf("%-16s %-10s %-8s %10s %10s %12s   one ray a call, ns\n", "scene", "rays", "query",
                "kernel", "door", "difference");
    for (const std::string& file : options.scenes) {
        const std::string name = std::filesystem::path(file).stem().string();
        const test::SceneFile scene = test::load_file(file);
        const test::World world(scene.triangles, options.threads);
        Door door(plugin.api(), world.triangles);
        Bare bare{world.target(), {}};
        measure(name, {"outside", rays_outside(world.bvh.bounds)}, options, door, bare, rows);
        for (const test::RaySet& set :
             test::make_ray_sets(world.triangles, scene.eyes, scene.lights, kRays, 1))
            if (set.name == "shadow" || set.name == "random")
                measure(name, set, options, door, bare, rows);
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
