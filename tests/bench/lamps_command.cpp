// Few and many lamps over a level: frames, and commits that move all of them.
#include "commands.h"
#include "frame_stage.h"
#include "image_size.h"
#include "timing.h"

#include "camera.h"
#include "gltf/import.h"
#include "plugin.h"
#include "support/world.h"
#include "upload.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

namespace peregrine::bench {
namespace {

constexpr uint32_t kCounts[] = {20, 200, 2'000, 10'000};
constexpr double kShare = 4;    // lamps that reach a place of the level's box, on average, ...
constexpr float kSmall = 2;     // ... or metres: the radius of all
constexpr float kHeight = 0.7f; // of lamps over surfaces, in parts of the radius
constexpr float kAmbient = 0.1f;
constexpr uint32_t kWarmUp = 3; // moves, until their memory is there

// Points on a level's surfaces, each part of these being as likely as any other.
class Places {
public:
    Places(const std::vector<geometry::Triangle>& triangles, uint32_t seed)
        : triangles_(triangles), random_(seed) {
        double sum = 0;
        for (const geometry::Triangle& triangle : triangles)
            sums_.push_back(sum += double(glm::length(across(triangle))));
    }

    glm::dvec3 next(float height) {
        std::uniform_real_distribution<double> unit(0, 1);
        const double at = unit(random_) * sums_.back();
        const auto found = std::lower_bound(sums_.begin(), sums_.end(), at) - sums_.begin();
        const geometry::Triangle& triangle = triangles_[size_t(found)];
        double u = unit(random_), v = unit(random_);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::dvec3 a(triangle.v0), b(triangle.v1), c(triangle.v2);
        const auto up = glm::dvec3(glm::normalize(across(triangle)));
        return a + u * (b - a) + v * (c - a) + double(height) * up;
    }

private:
    static math::Vec3 across(const geometry::Triangle& triangle) {
        return glm::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
    }

    const std::vector<geometry::Triangle>& triangles_;
    std::vector<double> sums_;
    std::mt19937 random_;
};

// A level whose own lights gave way to lamps.
class LampStage {
public:
    LampStage(const rt_api& api, const host::Level& level, uint32_t threads)
        : stage_(api, threads, RT_ISA_BEST) {
        lights_ = host::upload_level(stage_, level, kAmbient).lights;
        for (const host::Light& light : level.lights) lamps_.push_back(host::describe_light(light));
        commit();
    }

    rt_commit_report commit() {
        rt_commit_report report = rt_default_commit_report();
        stage_.check(stage_.api().commit_scene(stage_.scene(), nullptr, &report), "building");
        return report;
    }

    void move(uint32_t step) {
        for (size_t i = 0; i < lamps_.size(); ++i) {
            rt_light_desc lamp = lamps_[i];
            lamp.position[0] += 0.2 * std::cos(0.1 * double(step + i));
            lamp.position[2] += 0.2 * std::sin(0.1 * double(step + i));
            stage_.check(stage_.api().update_light(stage_.scene(), lights_[i], &lamp), "moving");
        }
    }

    rt_frame_stats render(const host::Viewpoint& view, const rt_frame_desc& frame) {
        const rt_camera camera = host::camera_of(view);
        rt_frame_stats stats = rt_default_frame_stats();
        stage_.check(stage_.api().render_frame(stage_.scene(), &camera, &frame, &stats),
                     "rendering");
        return stats;
    }
    uint64_t allocations() const { return stage_.stats().allocation_count; }

private:
    host::Stage stage_;
    std::vector<rt_light> lights_;
    std::vector<rt_light_desc> lamps_;
};

class Command {
public:
    Command(const Options& options, const rt_api& api, const std::string& file)
        : options_(options), api_(api), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), triangles_(test::load_file(file).triangles),
          views_(standing_cameras(level_)), size_(parse_image_size(options.frame_size)),
          memory_(size_.width, size_.height) {}

    nlohmann::json run() {
        std::printf("%s, %s\n%7s %9s %10s %10s %11s %10s %10s %12s\n", name_.c_str(),
                    size_.text().c_str(), "lamps", "radius", "frame ms", "rays/pixel", "update ms",
                    "commit ms", "frame ms", "allocations");
        const glm::dvec3 sides = level_.bounds.upper - level_.bounds.lower;
        const double volume = sides.x * sides.y * sides.z;
        for (const uint32_t count : kCounts)
            measure(count, float(std::cbrt(kShare * volume * 0.2387 / count)));
        for (const uint32_t count : kCounts) measure(count, kSmall);
        return rows_;
    }

private:
    void scatter(uint32_t count, float radius) {
        Places places(triangles_, count);
        level_.lights.clear();
        for (uint32_t i = 0; i < count; ++i) {
            host::Light light;
            light.position = places.next(kHeight * radius);
            light.radius = radius;
            light.intensity = glm::vec3(0.3f * radius * radius);
            level_.lights.push_back(light);
        }
    }

    double milliseconds(const Seconds& seconds) const {
        return 1e3 * (options_.threads == 1 ? seconds.processor : seconds.wall);
    }

    // Milliseconds of a frame, the mean of all cameras.
    double render_all(LampStage& stage, double& rays) {
        rt_frame_desc frame = memory_.frame(Look::exact);
        frame.least_light = options_.least_light;
        rays = 0;
        const Seconds start = Seconds::now();
        for (const host::Viewpoint& view : views_) {
            const rt_frame_stats stats = stage.render(view, frame);
            rays += double(stats.rays_shadow) / double(stats.rays_primary);
        }
        rays /= double(views_.size());
        return milliseconds(Seconds::now() - start) / double(views_.size());
    }

    void measure(uint32_t count, float radius) {
        std::fprintf(stderr, "%s: %u lamps\n", name_.c_str(), count);
        scatter(count, radius);
        LampStage stage(api_, level_, options_.threads);
        double rays = 0;
        std::vector<double> still, update, commit, moving;
        for (uint32_t pass = 0; pass < options_.passes; ++pass)
            still.push_back(render_all(stage, rays));
        uint64_t allocations = 0;
        for (uint32_t step = 0; step < kWarmUp + options_.passes; ++step) {
            const Seconds start = Seconds::now();
            stage.move(step);
            const Seconds moved = Seconds::now();
            const uint64_t before = stage.allocations();
            stage.commit();
            allocations = stage.allocations() - before;
            const Seconds end = Seconds::now();
            if (step < kWarmUp) continue;
            update.push_back(milliseconds(moved - start));
            commit.push_back(milliseconds(end - moved));
            double moving_rays = 0;
            moving.push_back(render_all(stage, moving_rays));
        }
        std::printf("%7u %9.2f %10.2f %10.2f %11.3f %10.3f %10.2f %12llu\n", count, double(radius),
                    median(still), rays, median(update), median(commit), median(moving),
                    static_cast<unsigned long long>(allocations));
        std::fflush(stdout);
        rows_.push_back({{"scene", name_},
                         {"lamps", count},
                         {"radius", radius},
                         {"threads", options_.threads},
                         {"size", size_.text()},
                         {"frame_ms", median(still)},
                         {"rays_per_pixel", rays},
                         {"update_ms", median(update)},
                         {"commit_ms", median(commit)},
                         {"moving_frame_ms", median(moving)},
                         {"allocations_per_commit", allocations}});
    }

    const Options& options_;
    const rt_api& api_;
    std::string name_;
    host::Level level_;
    std::vector<geometry::Triangle> triangles_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameMemory memory_;
    nlohmann::json rows_ = nlohmann::json::array();
};

} // namespace

std::string run_lamps(const Options& options) {
    const host::Plugin plugin(options.library);
    nlohmann::json rows = nlohmann::json::array();
    for (const std::string& file : options.scenes)
        for (nlohmann::json& row : Command(options, plugin.api(), file).run())
            rows.push_back(std::move(row));
    return rows.dump(2);
}

} // namespace peregrine::bench
