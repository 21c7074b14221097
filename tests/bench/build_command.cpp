#include "commands.h"
#include "embree_peer.h"
#include "timing.h"

#include "accel/kdtree/builder.h"
#include "support/ray_sets.h"
#include "support/world.h"
#include "trace/kernels.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace peregrine::bench {
namespace {

constexpr size_t kCameraRays = 50'000;

struct Built {
    double seconds;
    uint64_t bytes;
    size_t nodes, references;
    accel::kdtree::BuildReport report;
    double ns_a_ray;
};

// Camera rays, one at a time, by this thread.
double trace_camera_rays(const std::vector<geometry::Triangle>& triangles,
                         const accel::kdtree::Tree& tree, const std::vector<math::Ray>& rays) {
    const trace::Target target{nullptr,         tree.bounds,       nullptr,
                               nullptr,         tree.nodes.data(), tree.references.data(),
                               triangles.data()};
    const trace::Kernels& kernels =
        *trace::select_kernels(trace::Structure::kdtree, base::Isa::best);
    const double start = thread_seconds();
    for (const math::Ray& ray : rays) kernels.closest(target, ray, {});
    return 1e9 * (thread_seconds() - start) / double(rays.size());
}

Built build_ours(const std::vector<geometry::Triangle>& triangles,
                 const std::vector<math::Ray>& rays, float empty_bonus, base::Scheduler& scheduler,
                 base::HostMemory& memory) {
    accel::kdtree::BuildOptions build;
    build.empty_bonus = empty_bonus;
    const double start = wall_seconds();
    const accel::kdtree::Tree tree = accel::kdtree::build(triangles, build, scheduler, {}, &memory);
    const double seconds = wall_seconds() - start;
    const uint64_t bytes = tree.nodes.size() * sizeof(accel::kdtree::Node)
                           + tree.references.size() * sizeof(uint32_t)
                           + triangles.size() * sizeof(geometry::Triangle);
    return {seconds,           bytes,
            tree.nodes.size(), tree.references.size(),
            tree.report,       trace_camera_rays(triangles, tree, rays)};
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
    if (embree && !has_embree()) build_with_embree({}, 1); // throws its sentence
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
            built = build_ours(triangles, rays, options.empty_bonus, scheduler, memory);
            ours.push_back(built.seconds);
            ns_a_ray.push_back(built.ns_a_ray);
            if (!embree) continue;
            peer = build_with_embree(triangles, options.threads);
            theirs.push_back(peer.seconds);
        }
        report(name, triangles.size(), options, rows, "peregrine", ours, built.bytes);
        std::printf("%-16s %9s  %zu nodes, %zu references, SAH cost %.1f, %.0f ns a camera ray\n",
                    "", "", built.nodes, built.references, built.report.sah_cost, median(ns_a_ray));
        rows.back()["empty_bonus"] = options.empty_bonus;
        rows.back()["ns_per_camera_ray"] = median(ns_a_ray);
        rows.back()["nodes"] = built.nodes;
        rows.back()["references"] = built.references;
        rows.back()["max_depth"] = built.report.max_depth;
        rows.back()["sah_cost"] = built.report.sah_cost;
        if (embree) {
            report(name, triangles.size(), options, rows, "embree", theirs, peer.bytes);
            std::printf("%-16s %9s  ratio of times %.2f\n", "", "", median(ours) / median(theirs));
        }
    }
    return rows.dump(2);
}

} // namespace peregrine::bench
