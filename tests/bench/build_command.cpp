#include "commands.h"
#include "embree_peer.h"
#include "timing.h"

#include "scene/build.h"
#include "support/ray_sets.h"
#include "support/world.h"
#include "trace/kernels.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

namespace peregrine::bench {
namespace {

constexpr size_t kCameraRays = 50'000;

struct Built {
    double seconds;
    uint64_t bytes;
    size_t nodes, references;
    double sah_cost;
    uint32_t max_depth;
    double ns_a_ray;
};

// Camera rays, one at a time, by this thread.
double trace_camera_rays(const scene::Geometry& geometry, const std::vector<math::Ray>& rays) {
    const trace::Target target = geometry.target();
    const trace::Kernels& kernels =
        *trace::select_kernels(geometry.structure, base::Isa::best, geometry.is_compact());
    const double start = thread_seconds();
    for (const math::Ray& ray : rays) kernels.closest(target, ray, {});
    return 1e9 * (thread_seconds() - start) / double(rays.size());
}

template <class T>
uint64_t bytes_of(const base::Vector<T>& vector) {
    return vector.size() * sizeof(T);
}

uint64_t bytes_of(const scene::Geometry& geometry) {
    return bytes_of(geometry.infos) + bytes_of(geometry.triangles) + bytes_of(geometry.bvh.nodes)
           + bytes_of(geometry.bvh.blocks) + bytes_of(geometry.compact_bvh.nodes)
           + bytes_of(geometry.compact_bvh.leaves) + bytes_of(geometry.kdtree.nodes)
           + bytes_of(geometry.kdtree.references) + bytes_of(geometry.bih.nodes)
           + bytes_of(geometry.bih.references);
}

Built describe(const scene::Geometry& geometry) {
    const auto& [bvh, kdtree, bih] = std::tie(geometry.bvh, geometry.kdtree, geometry.bih);
    switch (geometry.structure) {
    case trace::Structure::kdtree:
        return {0,
                bytes_of(geometry),
                kdtree.nodes.size(),
                kdtree.references.size(),
                kdtree.report.sah_cost,
                kdtree.report.max_depth,
                0};
    case trace::Structure::bih:
        return {0,
                bytes_of(geometry),
                bih.nodes.size(),
                bih.references.size(),
                bih.report.sah_cost,
                bih.report.max_depth,
                0};
    default:
        return {0,
                bytes_of(geometry),
                bvh.nodes.size() + geometry.compact_bvh.nodes.size(),
                bvh.report.references,
                bvh.report.sah_cost,
                bvh.report.max_depth,
                0};
    }
}

Built build_ours(const std::vector<geometry::Triangle>& triangles,
                 const std::vector<math::Ray>& rays, const scene::BuildChoice& choice,
                 base::Scheduler& scheduler, base::HostMemory& memory) {
    scene::Geometry geometry(&memory);
    geometry.triangles.assign(triangles.begin(), triangles.end());
    for (const geometry::Triangle& triangle : triangles) geometry.infos.push_back(triangle.info());
    const double start = wall_seconds();
    scene::build_structure(choice, scheduler, {}, &memory, geometry);
    const double seconds = wall_seconds() - start;
    Built built = describe(geometry);
    built.seconds = seconds;
    built.ns_a_ray = trace_camera_rays(geometry, rays);
    return built;
}

scene::BuildChoice choice_of(const Options& options) {
    scene::BuildChoice choice;
    choice.structure = options.structure == "kdtree" ? trace::Structure::kdtree
                       : options.structure == "bih"  ? trace::Structure::bih
                                                     : trace::Structure::bvh;
    choice.quality = options.build == "fast"   ? accel::bvh::Quality::fast
                     : options.build == "best" ? accel::bvh::Quality::best
                                               : accel::bvh::Quality::balanced;
    choice.empty_bonus = options.empty_bonus;
    choice.compact = options.compact;
    return choice;
}

void report(const std::string& name, size_t count, const Options& options, nlohmann::json& rows,
            const char* contestant, const std::vector<double>& seconds, uint64_t bytes) {
    const double ms = 1e3 * median(seconds);
    const double per_triangle = double(bytes) / double(std::max<size_t>(1, count));
    std::printf("%-16s %9zu  %-9s %3u threads %9.1f ms %8.1f bytes a triangle\n", name.c_str(),
                count, contestant, options.threads, ms, per_triangle);
    rows.push_back({{"scene", name},
                    {"triangles", count},
                    {"contestant", contestant},
                    {"threads", options.threads},
                    {"build_ms", ms},
                    {"bytes_per_triangle", per_triangle}});
}

} // namespace

std::string run_build(const Options& options) {
    const bool embree = std::ranges::count(options.peers, "embree") > 0;
    if (options.peers.size() != size_t(embree))
        throw std::runtime_error("unknown peer; known: embree");
    if (embree && !has_embree()) build_with_embree({}, 1, {}); // throws its sentence
    nlohmann::json rows = nlohmann::json::array();
    base::HostMemory memory({});
    base::Scheduler scheduler(options.threads, {}, &memory);
    for (const std::string& file : options.scenes) {
        const std::string name = std::filesystem::path(file).stem().string();
        const test::SceneFile scene = test::load_file(file);
        const std::vector<geometry::Triangle>& triangles = scene.triangles;
        const std::vector<math::Ray> rays =
            test::make_ray_sets(triangles, scene.eyes, scene.lights, kCameraRays, 1)[0].rays;
        std::vector<double> ours, theirs, ns_a_ray;
        Built built{};
        PeerBuild peer{};
        for (uint32_t pass = 0; pass < options.passes; ++pass) {
            built = build_ours(triangles, rays, choice_of(options), scheduler, memory);
            ours.push_back(built.seconds);
            ns_a_ray.push_back(built.ns_a_ray);
            if (!embree) continue;
            peer = build_with_embree(triangles, options.threads, options.peer_build);
            theirs.push_back(peer.seconds);
        }
        report(name, triangles.size(), options, rows, "peregrine", ours, built.bytes);
        std::printf("%-16s %9s  %s%zu nodes, %zu references, SAH cost %.1f, %.0f ns a camera ray\n",
                    "", "", options.compact ? "compact, " : "", built.nodes, built.references,
                    built.sah_cost, median(ns_a_ray));
        rows.back()["structure"] = options.structure;
        rows.back()["build"] = options.build;
        rows.back()["compact"] = options.compact;
        rows.back()["empty_bonus"] = options.empty_bonus;
        rows.back()["ns_per_camera_ray"] = median(ns_a_ray);
        rows.back()["nodes"] = built.nodes;
        rows.back()["references"] = built.references;
        rows.back()["max_depth"] = built.max_depth;
        rows.back()["sah_cost"] = built.sah_cost;
        if (embree) {
            report(name, triangles.size(), options, rows, "embree", theirs, peer.bytes);
            rows.back()["build"] = options.peer_build;
            std::printf("%-16s %9s  ratio of times %.2f\n", "", "", median(ours) / median(theirs));
        }
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
