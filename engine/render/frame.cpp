#include "render/frame.h"

#include "render/worker.h"
#include "scene/alpha_test.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace peregrine::render {
namespace {

// The features that a frame looks at.
uint32_t features_seen(const scene::Snapshot& snapshot, const Frame& frame) {
    if (!frame.pixels) return 0;
    return frame.view == View::shaded ? snapshot.features : snapshot.features & scene::kNormalMaps;
}

trace::Filter primary_filter(const scene::Snapshot& snapshot) {
    trace::Filter filter;
    filter.cull_single_sided = (snapshot.features & scene::kSingleSidedMaterials) != 0;
    filter.alpha = scene::alpha_test(snapshot);
    return filter;
}

constexpr double kFar = 1024; // metres

// What surfaces and lights are relative to while they are shaded: the world's origin, or the eye if
// it sees meshes that keep their precision far away from there.
math::Vec3d shading_origin(const scene::Snapshot& snapshot, const math::Vec3d& eye) {
    const bool is_far = std::max({std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z)}) > kFar;
    return is_far && !snapshot.placements.empty() ? eye : math::Vec3d(0);
}

} // namespace

void render_frame(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
                  base::Scheduler& scheduler, base::Memory* memory, FrameStats* stats) {
    const auto begin = std::chrono::steady_clock::now();
    base::Vector<shade::PreparedLight> lights(memory);
    const math::Vec3d origin = shading_origin(snapshot, camera.position);
    if (frame.pixels) {
        lights.reserve(snapshot.lights.size());
        for (const scene::Light& light : snapshot.lights)
            lights.push_back(shade::prepare(light, snapshot.world.bounds, origin));
    }

    const FrameContext context = {snapshot,
                                  frame,
                                  Pinhole(camera, frame.width, frame.height),
                                  camera.position,
                                  primary_filter(snapshot),
                                  shade::Shader::prepare(snapshot, features_seen(snapshot, frame),
                                                         frame.shadows, lights, origin),
                                  Output::choose(frame)};
    if (context.shader.proofs_hold())
        for (size_t i = 0; i < std::min(lights.size(), snapshot.light_views.size()); ++i)
            lights[i].visibility = snapshot.light_views[i].get();
    const uint32_t tile_count = Tile::tile_count(frame.width, frame.height);
    const uint32_t worker_count = std::min(scheduler.concurrency(), tile_count);
    base::Vector<Worker> workers(worker_count, memory);
    std::atomic<uint32_t> next_tile{0};
    scheduler.for_each(worker_count, [&](uint32_t i) {
        workers[i].begin(context);
        for (uint32_t tile;
             (tile = next_tile.fetch_add(1, std::memory_order_relaxed)) < tile_count;)
            workers[i].render(context, tile);
    });

    if (!stats) return;
    stats->threads = scheduler.concurrency();
    stats->rays_primary = uint64_t(frame.width) * frame.height;
    stats->rays_shadow = 0;
    for (const Worker& worker : workers) stats->rays_shadow += worker.shadow_ray_count();
    stats->isa = snapshot.isa();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    stats->frame_ms = elapsed.count();
}

} // namespace peregrine::render
