#include "commands.h"
#include "embree_peer.h"
#include "timing.h"

#include "accel/kdtree/builder.h"
#include "support/world.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace peregrine::bench {
namespace {

struct Built {
    double seconds;
    uint64_t bytes;
    size_t nodes, references;
    accel::kdtree::BuildReport report;
};

Built build_ours(const std::vector<geometry::Triangle>& triangles, base::Scheduler& scheduler,
                 base::HostMemory& memory) {
    const double start = wall_seconds();
    const accel::kdtree::Tree tree = accel::kdtree::build(triangles, {}, scheduler, {}, &memory);
    const double seconds = wall_seconds() - start;
    const uint64_t bytes = tree.nodes.size() * sizeof(accel::kdtree::Node)
                           + tree.references.size() * sizeof(uint32_t)
                           + triangles.size() * sizeof(geometry::Triangle);
    return {seconds, bytes, tree.nodes.size(), tree.references.size(), tree.report};
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
        const std::vector<geometry::Triangle> triangles = test::load_file(file).triangles;
        std::vector<double> ours, theirs;
        Built built{};
        PeerBuild peer{};
        for (uint32_t pass = 0; pass < options.passes; ++pass) {
            built = build_ours(triangles, scheduler, memory);
            ours.push_back(built.seconds);
            if (!embree) continue;
            peer = build_with_embree(triangles, options.threads);
            theirs.push_back(peer.seconds);
        }
        report(name, triangles.size(), options, rows, "peregrine", ours, built.bytes);
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
