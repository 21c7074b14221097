// The tables of section 4 of the paper (Bikker 2007), with our scenes.
#include "commands.h"
#include "frame_stage.h"
#include "image_size.h"
#include "isa_name.h"
#include "timing.h"

#include "gltf/import.h"
#include "plugin.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

struct Shading {
    const char* name;
    bool shadows;
    uint32_t depth; // of paths
};
// "Basic" and "full" are not defined there. Full is a frame as it is by default.
constexpr Shading kShadings[] = {{"basic", false, 0}, {"full", true, 4}};

struct Shot {
    double ms = 0, mrays_per_s = 0;
};

class Paper {
public:
    Paper(const Options& options, const rt_api& api, const std::string& file)
        : options_(options), api_(api), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), views_(standing_cameras(level_)),
          size_(parse_image_size(options.frame_size)), memory_(size_.width, size_.height) {}

    // The best and the worst view.
    nlohmann::json performance() {
        nlohmann::json rows = nlohmann::json::array();
        const FrameStage stage = make_stage(options_.threads);
        for (const Shading& shading : kShadings) {
            double ghz = measure_ghz();
            std::vector<Shot> shots;
            for (const host::Viewpoint& view : views_) shots.push_back(shoot(stage, shading, view));
            ghz = 0.5 * (ghz + measure_ghz());
            const auto [fast, slow] =
                std::minmax_element(shots.begin(), shots.end(),
                                    [](const Shot& a, const Shot& b) { return a.ms < b.ms; });
            const auto [few, many] =
                std::minmax_element(shots.begin(), shots.end(), [](const Shot& a, const Shot& b) {
                    return a.mrays_per_s < b.mrays_per_s;
                });
            const double unit = ghz * options_.threads;
            std::printf("%-16s %9zu %6zu %-6s %8.1f %8.1f %8.1f %8.1f %9.2f %9.2f\n", name_.c_str(),
                        level_.triangle_count(), level_.lights.size(), shading.name,
                        few->mrays_per_s, many->mrays_per_s, slow->ms, fast->ms,
                        few->mrays_per_s / unit, many->mrays_per_s / unit);
            std::fflush(stdout);
            rows.push_back({{"scene", name_},
                            {"shading", shading.name},
                            {"triangles", level_.triangle_count()},
                            {"lights", level_.lights.size()},
                            {"threads", options_.threads},
                            {"size", size_.text()},
                            {"mrays_per_s", {few->mrays_per_s, many->mrays_per_s}},
                            {"ms", {slow->ms, fast->ms}},
                            {"ghz", ghz}});
        }
        return rows;
    }

    // Of the worst view, fully shaded.
    nlohmann::json scaling() {
        nlohmann::json rows = nlohmann::json::array();
        const FrameStage one = make_stage(1);
        size_t worst = 0;
        double most = 0;
        for (size_t view = 0; view < views_.size(); ++view) {
            const double ms = shoot(one, kShadings[1], views_[view]).ms;
            if (ms <= most) continue;
            most = ms;
            worst = view;
        }
        double first = 0;
        for (uint32_t threads = 1; threads <= options_.threads; ++threads) {
            const Shot shot = shoot(make_stage(threads), kShadings[1], views_[worst]);
            if (threads == 1) first = shot.ms;
            std::printf("%-16s %7u %10.1f %10.2f %8.2f\n", name_.c_str(), threads, shot.ms,
                        shot.mrays_per_s, first / shot.ms);
            std::fflush(stdout);
            rows.push_back({{"scene", name_},
                            {"threads", threads},
                            {"ms", shot.ms},
                            {"mrays_per_s", shot.mrays_per_s},
                            {"times_one", first / shot.ms}});
        }
        return rows;
    }

private:
    FrameStage make_stage(uint32_t threads) const {
        return FrameStage(api_, level_, threads, RT_LIGHT_PROOFS_KEPT, to_isa(options_.isa));
    }

    Shot shoot(const FrameStage& stage, const Shading& shading, const host::Viewpoint& view) {
        rt_frame_desc frame = memory_.frame(Look::direct);
        frame.no_shadows = shading.shadows ? 0 : 1;
        frame.max_depth = shading.depth;
        std::vector<double> ms;
        RenderedFrame rendered = stage.render(frame, view);
        for (uint32_t pass = 0; pass < options_.passes; ++pass) {
            rendered = stage.render(frame, view);
            ms.push_back(1e3 * rendered.seconds.wall);
        }
        const rt_frame_stats& stats = rendered.stats;
        const double rays = double(stats.rays_primary + stats.rays_shadow + stats.rays_bounced);
        return {median(ms), 1e-3 * rays / median(ms)};
    }

    const Options& options_;
    const rt_api& api_;
    std::string name_;
    host::Level level_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameMemory memory_;
};

void append(nlohmann::json& rows, nlohmann::json more) {
    for (nlohmann::json& row : more) rows.push_back(std::move(row));
}

} // namespace

std::string run_paper(const Options& options) {
    parse_image_size(options.frame_size); // complains before anything is built
    const host::Plugin plugin(options.library);
    nlohmann::json rows = nlohmann::json::array();
    std::printf("Table 1: million rays a second of the worst and the best view, wall time on %u "
                "threads; last, a thread and GHz\n%-16s %9s %6s %-6s %8s %8s %8s %8s %9s %9s\n",
                options.threads, "scene", "triangles", "lights", "shade", "MRays/s", "to", "ms",
                "to", "unit", "to");
    for (const std::string& file : options.scenes)
        append(rows, Paper(options, plugin.api(), file).performance());
    std::printf("\nTable 2: the worst view by threads\n%-16s %7s %10s %10s %8s\n", "scene",
                "threads", "ms", "MRays/s", "x 1");
    for (const std::string& file : options.scenes)
        append(rows, Paper(options, plugin.api(), file).scaling());
    return rows.dump();
}

} // namespace peregrine::bench
