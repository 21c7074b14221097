// What a world that moves costs, behind the door: commits, and rays that miss what moves.
#include "commands.h"
#include "embree_peer.h"
#include "moving_rays.h"
#include "moving_world.h"
#include "timing.h"

#include "plugin.h"
#include "support/world.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

constexpr uint32_t kWarmUp = 5; // commits, until their memory is there
constexpr uint32_t kPoses = 8;
constexpr uint32_t kLeastCommits = 20; // measured, a pass

// In milliseconds, a value a commit; `processor` is the commit's time on all processors, which a
// busy machine does not stretch.
struct Costs {
    std::vector<double> describe, build, commit, processor;
    double allocations = 0, bytes = 0; // a commit
    rt_scene_stats before{};

    void begin(const MovingWorld& world) { before = world.stats(); }
    void end(const MovingWorld& world) {
        const rt_scene_stats after = world.stats();
        const auto count = double(commit.size());
        allocations = double(after.allocation_count - before.allocation_count) / count;
        bytes = double(after.bytes_peak - before.bytes_peak) / count;
    }
};

// describe(step), then a commit, again and again.
template <class Describe>
Costs measure_commits(MovingWorld& world, uint32_t commits, Describe&& describe) {
    Costs costs;
    for (uint32_t step = 0; step < kWarmUp + commits; ++step) {
        if (step == kWarmUp) costs.begin(world);
        const double start = wall_seconds();
        describe(step);
        const double seconds = wall_seconds() - start;
        const double processor = process_seconds();
        const rt_commit_report report = world.commit();
        if (step < kWarmUp) continue;
        costs.processor.push_back(1e3 * (process_seconds() - processor));
        costs.describe.push_back(1e3 * seconds);
        costs.build.push_back(report.dynamic_build_ms);
        costs.commit.push_back(report.commit_ms);
    }
    costs.end(world);
    return costs;
}

void add_costs(nlohmann::json& row, const Costs& costs) {
    row["describe_ms"] = median(costs.describe);
    row["commit_ms"] = median(costs.commit);
    row["commit_processor_ms"] = median(costs.processor);
    row["allocations_per_commit"] = costs.allocations;
    row["new_bytes_per_commit"] = costs.bytes;
}

class Command {
public:
    Command(const Options& options, const rt_api& api, const std::string& file)
        : options_(options), api_(api), name_(std::filesystem::path(file).stem().string()),
          level_(test::load_file(file)) {}

    nlohmann::json run() {
        std::fprintf(stderr, "%s: deforming meshes\n", name_.c_str());
        std::printf("%s: deforming triangles, %u threads\n%9s %10s %10s %10s %10s %8s %11s %10s",
                    c_name(), options_.threads, "triangles", "update ms", "build ms", "commit ms",
                    "processor", "ns each", "allocations", "new bytes");
        std::printf(has_embree() ? " %11s %11s\n" : "\n", "Embree low", "refitted");
        for (const uint32_t triangles : {1'000u, 2'500u, 10'000u, 100'000u}) deform(triangles);
        std::fprintf(stderr, "%s: instances\n", name_.c_str());
        std::printf("%s: rigid instances\n%9s %9s %10s %10s %10s %11s %10s\n", c_name(),
                    "instances", "moved", "set ms", "commit ms", "processor", "allocations",
                    "new bytes");
        for (const uint32_t count : {1u, 100u, 1'000u, 10'000u}) move(count, count);
        move(10'000, 1);
        std::fprintf(stderr, "%s: transforms\n", name_.c_str());
        std::printf("%s: rt_set_mesh_transform\n%9s %10s\n", c_name(), "triangles", "ns a call");
        for (const uint32_t triangles : {10u, 1'000u, 100'000u, 1'000'000u}) set(triangles);
        std::fprintf(stderr, "%s: rays\n", name_.c_str());
        std::printf("%s: rays that miss what moves, ns a ray without and with it\n", c_name());
        std::printf("%-24s %-10s %-10s %10s %10s %7s\n", "what moves", "rays", "asked", "without",
                    "with", "ratio");
        for (const RayCost& cost : measure_rays(api_, level_, options_.passes)) add(cost);
        return rows_;
    }

private:
    const char* c_name() const { return name_.c_str(); }
    nlohmann::json& add_row(const char* what) {
        rows_.push_back({{"scene", name_}, {"what", what}, {"threads", options_.threads}});
        return rows_.back();
    }

    MovingWorld& with_level(MovingWorld& world) const {
        world.add_level(level_.triangles);
        return world;
    }

    void deform(uint32_t triangles) {
        const Ball ball(triangles, {}, 1);
        std::vector<std::vector<math::Vec3>> poses;
        for (uint32_t step = 0; step < kPoses; ++step) poses.push_back(ball.pose(step));
        MovingWorld world(api_, options_.threads);
        const rt_mesh mesh = with_level(world).add_deforming(ball);
        const uint32_t count = options_.passes * (triangles < 50'000 ? kLeastCommits : 5);
        std::vector<double> low, refitted;
        const auto peer_low =
            has_embree() ? deform_with_embree(ball.indices, poses[0], options_.threads, false)
                         : nullptr;
        const auto peer_refit =
            has_embree() ? deform_with_embree(ball.indices, poses[0], options_.threads, true)
                         : nullptr;
        const Costs costs = measure_commits(
            world, count, [&](uint32_t step) { world.deform(mesh, poses[step % kPoses]); });
        for (uint32_t step = 0; peer_low && step < count; ++step) {
            low.push_back(1e3 * peer_low->deform(poses[step % kPoses]));
            refitted.push_back(1e3 * peer_refit->deform(poses[step % kPoses]));
        }
        const double each =
            1e6 * (median(costs.describe) + median(costs.processor)) / double(triangles);
        std::printf("%9u %10.3f %10.3f %10.3f %10.3f %8.0f %11.2f %10.0f", triangles,
                    median(costs.describe), median(costs.build), median(costs.commit),
                    median(costs.processor), each, costs.allocations, costs.bytes);
        if (peer_low)
            std::printf(" %11.3f %11.3f\n", median(low), median(refitted));
        else
            std::printf("\n");
        nlohmann::json& row = add_row("deforming");
        add_costs(row, costs);
        row["triangles"] = triangles;
        row["build_ms"] = median(costs.build);
        row["ns_per_triangle"] = each;
        if (!peer_low) return;
        row["embree_low_ms"] = median(low);
        row["embree_refit_ms"] = median(refitted);
    }

    void move(uint32_t instances, uint32_t moved) {
        MovingWorld world(api_, options_.threads);
        std::vector<rt_mesh> meshes{with_level(world).add_rigid(Ball(500, {}, 1))};
        while (meshes.size() < instances) meshes.push_back(world.add_instance(meshes[0]));
        const auto place = [&](uint32_t i, uint32_t step) {
            world.place(meshes[i],
                        {3.0f * float(i % 100), 0.1f * float(step), 3.0f * float(i / 100)},
                        0.1f * float(step));
        };
        for (uint32_t i = 0; i < instances; ++i) place(i, 0);
        const Costs costs =
            measure_commits(world, options_.passes * kLeastCommits, [&](uint32_t step) {
                for (uint32_t i = 0; i < moved; ++i) place(i, step);
            });
        std::printf("%9u %9u %10.4f %10.4f %10.4f %11.2f %10.0f\n", instances, moved,
                    median(costs.describe), median(costs.commit), median(costs.processor),
                    costs.allocations, costs.bytes);
        nlohmann::json& row = add_row("instances");
        add_costs(row, costs);
        row["instances"] = instances;
        row["moved"] = moved;
    }

    void set(uint32_t triangles) {
        constexpr uint32_t kCalls = 10'000;
        MovingWorld world(api_, options_.threads);
        const rt_mesh mesh = world.add_rigid(Ball(triangles, {}, 1));
        world.commit();
        std::vector<double> ns;
        for (uint32_t pass = 0; pass < options_.passes; ++pass) {
            const double start = wall_seconds();
            for (uint32_t i = 0; i < kCalls; ++i) world.place(mesh, {}, 0);
            ns.push_back(1e9 * (wall_seconds() - start) / kCalls);
        }
        std::printf("%9u %10.0f\n", triangles, median(ns));
        nlohmann::json& row = add_row("set_transform");
        row["triangles"] = triangles;
        row["ns"] = median(ns);
    }

    void add(const RayCost& cost) {
        std::printf("%-24s %-10s %-10s %10.1f %10.1f %7.3f\n", cost.what.c_str(), cost.rays.c_str(),
                    cost.asked, cost.ns_without, cost.ns_with, cost.ratio);
        nlohmann::json& row = add_row("rays");
        row["moving"] = cost.what;
        row["rays"] = cost.rays;
        row["asked"] = cost.asked;
        row["ns_without"] = cost.ns_without;
        row["ns_with"] = cost.ns_with;
        row["ratio"] = cost.ratio;
    }

    const Options& options_;
    const rt_api& api_;
    std::string name_;
    test::SceneFile level_;
    nlohmann::json rows_ = nlohmann::json::array();
};

} // namespace

std::string run_moving(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const host::Plugin plugin(options.library);
    for (const std::string& file : options.scenes)
        for (nlohmann::json& row : Command(options, plugin.api(), file).run())
            rows.push_back(std::move(row));
    return rows.dump(2);
}

} // namespace peregrine::bench
