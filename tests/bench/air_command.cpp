// What bloom, fog, light in it and particles add to a frame.
#include "commands.h"
#include "frame_stage.h"
#include "image_size.h"
#include "isa_name.h"
#include "means.h"
#include "timing.h"

#include "air.h"
#include "gltf/import.h"
#include "image_file.h"
#include "plugin.h"
#include "upload.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace peregrine::bench {
namespace {

constexpr host::Fog kFog{0.05f, 3};
constexpr float kBloom = 0.2f, kAmbient = 0.1f, kScatter = 0.5f;

struct Setting {
    const char* name;
    bool blooms = false, fog = false;
    uint32_t particles = 0;
    bool lit = false;                // fog by all lamps, ...
    uint32_t shadows = 0, block = 1; // ... with rt_frame_desc::airlight_shadows, _block
};
constexpr Setting kSettings[] = {
    {.name = "none"},
    {.name = "bloom", .blooms = true},
    {.name = "particles", .particles = 2000},
    {.name = "many particles", .particles = 100000},
    {.name = "fog", .fog = true},
    {.name = "lit fog", .lit = true},
    {.name = "shadows in 2x2", .lit = true, .shadows = 8, .block = 2},
    {.name = "shadows in 4x4", .lit = true, .shadows = 8, .block = 4},
    {.name = "of each pixel", .lit = true, .shadows = 8},
    {.name = "fine shadows", .lit = true, .shadows = 32},
    {.name = "all", .blooms = true, .fog = true, .particles = 2000},
};

class Command {
public:
    Command(const Options& options, const rt_api& api, const std::string& file)
        : options_(options), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), views_(standing_cameras(level_)),
          size_(parse_image_size(options.frame_size)), memory_(size_.width, size_.height),
          stage_(api, level_, options.threads, RT_LIGHT_PROOFS_KEPT, to_isa(options.isa)) {}

    nlohmann::json run() {
        nlohmann::json rows = nlohmann::json::array();
        for (const Setting& setting : kSettings) {
            const Price price = measure(setting);
            std::printf("%-16s %-16s %8.2f %8.2f %+8.2f\n", name_.c_str(), setting.name,
                        price.none_ms, price.ms, price.ms - price.none_ms);
            std::fflush(stdout);
            rows.push_back({{"scene", name_},
                            {"setting", setting.name},
                            {"size", size_.text()},
                            {"threads", options_.threads},
                            {"frame_ms", price.ms},
                            {"without_ms", price.none_ms}});
        }
        return rows;
    }

private:
    struct Price {
        double none_ms = 0, ms = 0; // means of the cameras
    };

    void show_fog(bool fog) {
        if (fog == has_fog_) return;
        has_fog_ = fog;
        host::Stage& stage = stage_.stage();
        host::set_fog(stage, level_, fog ? kFog : host::Fog(), kAmbient);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
    }

    // Of the same scene with lamps that fog scatters.
    FrameStage& lit_stage() {
        if (lit_stage_) return *lit_stage_;
        host::light_fog(level_, kScatter);
        lit_stage_.emplace(stage_.stage().api(), level_, options_.threads, RT_LIGHT_PROOFS_KEPT,
                           to_isa(options_.isa));
        host::Stage& stage = lit_stage_->stage();
        host::set_fog(stage, level_, kFog, kAmbient);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
        return *lit_stage_;
    }

    double render(const Setting& setting, const std::vector<rt_particle>& embers, size_t view) {
        FrameStage& stage = setting.lit ? lit_stage() : stage_;
        if (!setting.lit) show_fog(setting.fog);
        rt_frame_desc frame = memory_.frame(Look::direct);
        frame.bloom = setting.blooms ? kBloom : 0;
        frame.particles = host::to_array(embers);
        frame.airlight_shadows = setting.shadows;
        frame.airlight_block = setting.block;
        const Seconds seconds = stage.render(frame, views_[view]).seconds;
        return 1e3 * (options_.threads == 1 ? seconds.processor : seconds.wall);
    }

    // In turns with frames without anything, so that what the machine does besides counts for both.
    Price measure(const Setting& setting) {
        const auto embers = host::make_embers(level_, setting.particles, /*seconds=*/0);
        Price price;
        for (size_t view = 0; view < views_.size(); ++view) {
            std::vector<double> none_ms, ms;
            render(kSettings[0], {}, view);
            for (uint32_t pass = 0; pass < options_.passes; ++pass) {
                none_ms.push_back(render(kSettings[0], {}, view));
                ms.push_back(render(setting, embers, view));
            }
            price.none_ms += median(none_ms) / double(views_.size());
            price.ms += median(ms) / double(views_.size());
            write(setting, view);
        }
        return price;
    }

    void write(const Setting& setting, size_t view) const {
        if (options_.pictures.empty()) return;
        std::string name = name_ + "_" + std::to_string(view) + "_" + setting.name + ".png";
        std::replace(name.begin(), name.end(), ' ', '_');
        host::write_picture_file(std::filesystem::path(options_.pictures) / name, size_.width,
                                 size_.height, memory_.pixels);
    }

    const Options& options_;
    std::string name_;
    host::Level level_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameMemory memory_;
    FrameStage stage_;
    std::optional<FrameStage> lit_stage_;
    bool has_fog_ = false;
};

} // namespace

std::string run_air(const Options& options) {
    const host::Plugin plugin(options.library);
    std::printf("%s a frame, mean of the scene's cameras\n%-16s %-16s %8s %8s %8s\n",
                options.threads == 1 ? "processor time" : "wall time", "scene", "setting",
                "without", "with", "more");
    nlohmann::json rows = nlohmann::json::array();
    for (const std::string& file : options.scenes)
        for (nlohmann::json& row : Command(options, plugin.api(), file).run())
            rows.push_back(std::move(row));
    return rows.dump();
}

} // namespace peregrine::bench
