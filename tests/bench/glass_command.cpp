// What paths take: frames of the scene of tests/pictures/glass_scene.h, by their greatest depth.
#include "../pictures/glass_scene.h"

#include "commands.h"
#include "image_size.h"
#include "timing.h"

#include "image_file.h"
#include "plugin.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

constexpr uint32_t kDepths[] = {0, 1, 2, 4, 8, 16};

class Command {
public:
    Command(const Options& options, const rt_api& api)
        : options_(options), size_(parse_image_size(options.frame_size)),
          stage_(api, options.threads, RT_ISA_BEST), scene_(stage_, {}),
          pixels_(size_t(size_.width) * size_.height * 4) {
        stage_.check(api.commit_scene(stage_.scene(), nullptr, nullptr), "building");
    }

    nlohmann::json run() {
        std::printf("%s\n%6s %10s %16s %16s\n", size_.text().c_str(), "depth", "frame ms",
                    "bounced/pixel", "shadow/pixel");
        nlohmann::json rows = nlohmann::json::array();
        for (const uint32_t depth : kDepths) rows.push_back(measure(depth));
        return rows;
    }

private:
    rt_frame_stats render(uint32_t depth) {
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = size_.width;
        frame.height = size_.height;
        frame.pixels = pixels_.data();
        frame.max_depth = depth;
        const rt_camera camera = scene_.camera();
        rt_frame_stats stats = rt_default_frame_stats();
        stage_.check(stage_.api().render_frame(stage_.scene(), &camera, &frame, &stats),
                     "rendering");
        return stats;
    }

    nlohmann::json measure(uint32_t depth) {
        rt_frame_stats stats{};
        std::vector<double> ms;
        for (uint32_t pass = 0; pass < options_.passes; ++pass) {
            const double start = options_.threads == 1 ? thread_seconds() : wall_seconds();
            stats = render(depth);
            const double end = options_.threads == 1 ? thread_seconds() : wall_seconds();
            ms.push_back(1e3 * (end - start));
        }
        const double bounced = double(stats.rays_bounced) / double(stats.rays_primary);
        const double shadow = double(stats.rays_shadow) / double(stats.rays_primary);
        std::printf("%6u %10.2f %16.3f %16.3f\n", depth, median(ms), bounced, shadow);
        std::fflush(stdout);
        if (!options_.pictures.empty())
            host::write_picture_file(std::filesystem::path(options_.pictures)
                                         / ("glass_" + std::to_string(depth) + ".png"),
                                     size_.width, size_.height, pixels_);
        return {{"max_depth", depth},
                {"threads", options_.threads},
                {"size", size_.text()},
                {"frame_ms", median(ms)},
                {"rays_bounced_per_pixel", bounced},
                {"rays_shadow_per_pixel", shadow}};
    }

    const Options& options_;
    ImageSize size_;
    host::Stage stage_;
    test::GlassScene scene_;
    std::vector<uint8_t> pixels_;
};

} // namespace

std::string run_glass(const Options& options) {
    const host::Plugin plugin(options.library);
    return Command(options, plugin.api()).run().dump(2);
}

} // namespace peregrine::bench
