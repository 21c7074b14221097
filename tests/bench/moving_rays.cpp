#include "moving_rays.h"

#include "moving_world.h"
#include "timing.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace peregrine::bench {
namespace {

constexpr size_t kRays = 4096;
constexpr uint32_t kBatch = 1024;
constexpr uint32_t kRounds = 10; // a pass

using Rays = std::vector<math::Ray>;

void ask(const MovingWorld& world, const Rays& rays, uint32_t batch, rt_hit* hits) {
    rt_query_desc query = rt_default_query_desc();
    for (size_t i = 0; i < rays.size(); i += batch) {
        query.rays = reinterpret_cast<const rt_ray*>(&rays[i]);
        query.ray_count = std::min<size_t>(batch, rays.size() - i);
        query.hits = hits + i;
        world.trace(query);
    }
}

double ns_a_ray(const MovingWorld& world, const Rays& rays, uint32_t batch) {
    std::vector<rt_hit> hits(rays.size());
    const double start = thread_seconds();
    ask(world, rays, batch, hits.data());
    return 1e9 * (thread_seconds() - start) / double(rays.size());
}

// Those whose answer is the same with and without.
Rays rays_that_miss(const MovingWorld& without, const MovingWorld& with, const Rays& rays) {
    std::vector<rt_hit> a(rays.size()), b(rays.size());
    ask(without, rays, kBatch, a.data());
    ask(with, rays, kBatch, b.data());
    Rays missing;
    for (size_t i = 0; i < rays.size(); ++i)
        if (a[i].t == b[i].t) missing.push_back(rays[i]);
    return missing;
}

RayCost measure(const MovingWorld& without, const MovingWorld& with, const Rays& rays,
                uint32_t batch, uint32_t rounds) {
    std::vector<double> ns_without, ns_with, ratio;
    for (uint32_t round = 0; round < rounds; ++round) { // in turns, on the same machine
        ns_without.push_back(ns_a_ray(without, rays, batch));
        ns_with.push_back(ns_a_ray(with, rays, batch));
        ratio.push_back(ns_with.back() / ns_without.back());
    }
    return {"",
            "",
            batch == 1 ? "one by one" : "in batches",
            median(ns_without),
            median(ns_with),
            median(ratio)};
}

// Where characters may stand: all over the level, in the midst of the air.
std::vector<math::Vec3> places(const MovingWorld& level, const Rays& rays, size_t count) {
    std::vector<rt_hit> hits(rays.size());
    ask(level, rays, kBatch, hits.data());
    std::vector<math::Vec3> found;
    for (size_t i = 0; i < rays.size() && found.size() < count; ++i)
        if (std::isfinite(hits[i].t))
            found.push_back(rays[i].origin + 0.5f * hits[i].t * rays[i].direction);
    return found;
}

const Rays& rays_of(const std::vector<test::RaySet>& sets, const char* name) {
    return std::ranges::find(sets, name, &test::RaySet::name)->rays;
}

} // namespace

std::vector<RayCost> measure_rays(const rt_api& api, const test::SceneFile& level,
                                  uint32_t passes) {
    MovingWorld without(api, 1);
    without.add_level(level.triangles);
    without.commit();
    math::Box bounds;
    for (const geometry::Triangle& triangle : level.triangles)
        bounds.extend(geometry::bounds(triangle));
    const float radius = 0.01f * glm::length(bounds.upper - bounds.lower);
    const std::vector<test::RaySet> sets =
        test::make_ray_sets(level.triangles, level.eyes, level.lights, kRays, 1);

    struct Moving {
        const char* name;
        uint32_t count;
        std::function<void(MovingWorld&, const std::vector<math::Vec3>&)> add;
    };
    const auto add_deforming = [&](MovingWorld& world, const std::vector<math::Vec3>& at) {
        for (const math::Vec3& center : at)
            world.add_deforming(Ball(2500 / uint32_t(at.size()) / 2 * 2, center, radius));
    };
    const auto add_instances = [&](MovingWorld& world, const std::vector<math::Vec3>& at) {
        const rt_mesh first = world.add_rigid(Ball(500, {}, radius));
        for (const math::Vec3& center : at) world.place(world.add_instance(first), center, 1);
        world.place(first, at[0], 0);
    };
    const Moving all[] = {{"2,500 triangles, 1 mesh", 1, add_deforming},
                          {"2,500 triangles, 5 meshes", 5, add_deforming},
                          {"10 instances", 10, add_instances},
                          {"1,000 instances", 1000, add_instances}};
    std::vector<RayCost> costs;
    for (const Moving& moving : all) {
        MovingWorld with(api, 1);
        with.add_level(level.triangles);
        moving.add(with, places(without, rays_of(sets, "random"), moving.count));
        with.commit();
        for (const test::RaySet& set : sets) {
            if (set.name != "camera" && set.name != "shadow" && set.name != "random") continue;
            const Rays rays = rays_that_miss(without, with, set.rays);
            for (const uint32_t batch : {1u, kBatch}) {
                costs.push_back(measure(without, with, rays, batch, passes * kRounds));
                costs.back().what = moving.name;
                costs.back().rays = set.name;
            }
        }
    }
    return costs;
}

} // namespace peregrine::bench
