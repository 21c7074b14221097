#include "commands.h"
#include "field.h"
#include "timing.h"

#include "gameplay/projectile.h"
#include "gameplay/random.h"
#include "gameplay/ray_grenade.h"
#include "gltf/import.h"
#include "plugin.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <glm/geometric.hpp>

namespace peregrine::bench {
namespace {

using gameplay::Grenade;
using gameplay::GrenadeRules;
using gameplay::RayGrenade;
using gameplay::Vec3;
using gameplay::World;

constexpr uint32_t kRates[] = {240, 120, 60, 30};
constexpr uint32_t kReferenceRate = 1000;
constexpr size_t kThrows = 20;

// Where a grenade is after half a second and after five.
struct Way {
    Vec3 early, late;
};

Way fly_spheres(const World& world, const GrenadeRules& rules, const Vec3& from,
                const Vec3& velocity, uint32_t rate) {
    Grenade grenade(world, rules, 0, from, velocity);
    Way way{};
    for (uint32_t tick = 1; tick <= 5 * rate; ++tick) {
        grenade.advance(world, double(tick) / rate);
        if (2 * tick == rate) way.early = grenade.position();
    }
    way.late = grenade.position();
    return way;
}

Way fly_rays(const World& world, const GrenadeRules& rules, const Vec3& from, const Vec3& velocity,
             uint32_t rate) {
    RayGrenade grenade{from, velocity};
    Way way{};
    for (uint32_t tick = 1; tick <= 5 * rate; ++tick) {
        gameplay::step(world, rules, grenade, 1.0 / rate);
        if (2 * tick == rate) way.early = grenade.position;
    }
    way.late = grenade.position;
    return way;
}

using Fly = Way (*)(const World&, const GrenadeRules&, const Vec3&, const Vec3&, uint32_t);

struct Throws {
    std::vector<Vec3> from, velocity;
};

Throws make_throws(const host::Level& level) {
    std::vector<Vec3> eyes;
    for (const host::Viewpoint& place : level.cameras) eyes.push_back(place.position);
    for (const host::Viewpoint& place : level.spawns) eyes.push_back(place.position);
    Throws throws;
    gameplay::Random random(1);
    for (size_t i = 0; i < kThrows && !eyes.empty(); ++i) {
        throws.from.push_back(eyes[random.below(uint32_t(eyes.size()))]);
        throws.velocity.push_back(12.0 * glm::normalize(random.in_ball()));
    }
    return throws;
}

// How far a game with this time step strays from the one with 1/1000 s.
void measure_steps(const std::string& scene, const char* method, Fly fly, const World& world,
                   const Throws& throws, nlohmann::json& rows) {
    GrenadeRules rules;
    rules.restitution = 0.6;
    std::vector<Way> reference;
    for (size_t i = 0; i < throws.from.size(); ++i)
        reference.push_back(fly(world, rules, throws.from[i], throws.velocity[i], kReferenceRate));
    for (const uint32_t rate : kRates) {
        std::vector<double> early, late;
        const double start = thread_seconds();
        for (size_t i = 0; i < throws.from.size(); ++i) {
            const Way way = fly(world, rules, throws.from[i], throws.velocity[i], rate);
            early.push_back(glm::distance(way.early, reference[i].early));
            late.push_back(glm::distance(way.late, reference[i].late));
        }
        const double us = 1e6 * (thread_seconds() - start) / double(throws.from.size() * 5 * rate);
        const double worst = *std::max_element(late.begin(), late.end());
        std::printf("%-16s %-8s 1/%-4u %12.3g %12.3g %12.3g %10.2f\n", scene.c_str(), method, rate,
                    median(early), median(late), worst, us);
        rows.push_back({{"scene", scene},
                        {"method", method},
                        {"rate", rate},
                        {"median_after_half_a_second_m", median(early)},
                        {"median_after_5_s_m", median(late)},
                        {"worst_after_5_s_m", worst},
                        {"us_a_tick", us}});
    }
}

// Restitution 1 on a plane: what is left of the height after a minute.
void measure_height(const rt_api& api, nlohmann::json& rows) {
    Field field(api);
    field.add_quad({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9});
    field.commit();
    GrenadeRules rules;
    rules.restitution = 1;
    for (const uint32_t rate : {30u, 60u, 120u, 240u, 1000u}) {
        Grenade grenade(field.world(), rules, 0, {0, 2 + rules.radius, 0}, Vec3(0));
        for (uint32_t tick = 1; tick <= 60 * rate; ++tick)
            grenade.advance(field.world(), double(tick) / rate);
        const Vec3 v = grenade.velocity();
        const double height =
            grenade.position().y - rules.radius + 0.5 * glm::dot(v, v) / -rules.gravity.y;
        std::printf("restitution 1 on a plane for 60 s at 1/%u s: %.6f of the height kept\n", rate,
                    height / 2);
        rows.push_back({{"test", "height"}, {"rate", rate}, {"kept", height / 2}});
    }
}

// Rolling over a flat grid of triangles, a metre a cell: how far the ball hops.
void measure_bumps(const rt_api& api, nlohmann::json& rows) {
    Field field(api);
    for (int x = -30; x < 30; ++x)
        for (int z = -3; z < 3; ++z)
            field.add_quad({x, 0, z}, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z});
    field.commit();
    GrenadeRules rules;
    rules.friction = rules.rolling_friction = 0;
    for (const double speed : {5.0, 20.0}) {
        Grenade grenade(field.world(), rules, 0, {-25.3, rules.radius, 0.2},
                        {speed, 0, 0.03 * speed});
        double bump = 0;
        for (int tick = 1; tick <= 120; ++tick) {
            grenade.advance(field.world(), tick / 60.0);
            bump = std::max(bump, std::abs(grenade.position().y - rules.radius));
        }
        std::printf("ghost bumps at %.0f m/s: %.4f mm\n", speed, 1e3 * bump);
        rows.push_back({{"test", "bumps"}, {"speed", speed}, {"highest_mm", 1e3 * bump}});
    }
}

// Bullets of 5 mm at 1000 m/s against a wall of 1 cm.
void measure_tunnelling(const rt_api& api, nlohmann::json& rows) {
    Field field(api);
    for (const double x : {20.0, 20.01})
        field.add_quad({x, -9, -9}, {x, -9, 9}, {x, 9, 9}, {x, 9, -9});
    field.commit();
    gameplay::Random random(1);
    int through = 0;
    for (int i = 0; i < 200; ++i) {
        const Vec3 from{random.between(-20, 19), random.between(-1, 1), 0};
        gameplay::Projectile bullet({}, 0, from, {1000, 0, 0});
        for (int tick = 1; tick <= 6; ++tick) bullet.advance(field.world(), tick / 60.0);
        through += bullet.position().x > 20;
    }
    std::printf("bullets through a wall of 1 cm: %d of 200\n", through);
    rows.push_back({{"test", "tunnelling"}, {"bullets", 200}, {"through", through}});
}

} // namespace

std::string run_grenade(const Options& options) {
    nlohmann::json rows = nlohmann::json::array();
    const host::Plugin plugin(options.library);
    std::printf("%-16s %-8s %-6s %12s %12s %12s %10s   from the same throw at 1/%u s\n", "scene",
                "method", "step", "m at 0.5 s", "m at 5 s", "worst", "us a tick", kReferenceRate);
    for (const std::string& file : options.scenes) {
        const host::Level level = host::gltf::import_file(file);
        const Throws throws = make_throws(level);
        if (throws.from.empty()) continue;
        Field field(plugin.api());
        field.add_level(level);
        field.commit();
        const std::string name = std::filesystem::path(file).stem().string();
        measure_steps(name, "spheres", fly_spheres, field.world(), throws, rows);
        measure_steps(name, "rays", fly_rays, field.world(), throws, rows);
    }
    measure_height(plugin.api(), rows);
    measure_bumps(plugin.api(), rows);
    measure_tunnelling(plugin.api(), rows);
    return rows.dump(2);
}

} // namespace peregrine::bench
