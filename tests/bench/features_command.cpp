// What each feature of a picture adds to a frame, alone and all together, in turns with frames
// that have none of it.
#include "commands.h"
#include "frame_peer.h"
#include "frame_stage.h"
#include "image_size.h"
#include "isa_name.h"
#include "means.h"
#include "standing_triangles.h"
#include "timing.h"

#include "effects/embers.h"
#include "effects/mist.h"
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
constexpr float kOcclusionRange = 1.0f; // metres
constexpr float kLampRadius = 0.1f;     // metres, of lamps that are spheres
constexpr uint32_t kFewParticles = 2000;

struct Setting {
    const char* name;
    uint32_t depth = 0; // of paths
    bool blooms = false, fog = false, occlusion = false, soft = false;
    bool lit_fog = false; // by all lamps that end somewhere
    bool tinted = false;  // shadows
    bool baked = false;   // what of it can be; else of none
    bool bounced = false; // light between surfaces, if baked
    uint32_t airlight_shadows = 0, particles = 0, edge_samples = 1, light_block = 1;

    bool has_everything() const { return blooms && fog && occlusion && particles > 0; }
};
constexpr Setting kNone = {.name = "none"};
constexpr Setting kSettings[] = {
    {.name = "mirrors, glass, blending", .depth = 4},
    {.name = "tinted shadows", .tinted = true},
    {.name = "soft shadows", .soft = true},
    {.name = "occlusion", .occlusion = true},
    {.name = "occlusion, baked", .occlusion = true, .baked = true},
    {.name = "bounced light, baked", .baked = true, .bounced = true},
    {.name = "bloom", .blooms = true},
    {.name = "fog", .fog = true},
    {.name = "lit fog", .lit_fog = true},
    {.name = "lit fog, shadows", .lit_fog = true, .airlight_shadows = 8},
    {.name = "2,000 particles", .particles = kFewParticles},
    {.name = "100,000 particles", .particles = 100000},
    {.name = "edges, 4 rays", .edge_samples = 4},
    {.name = "light in blocks of 8", .light_block = 8},
    {.name = "everything",
     .depth = 4,
     .blooms = true,
     .fog = true,
     .occlusion = true,
     .tinted = true,
     .particles = kFewParticles},
    {.name = "everything, baked",
     .depth = 4,
     .blooms = true,
     .fog = true,
     .occlusion = true,
     .tinted = true,
     .baked = true,
     .bounced = true,
     .particles = kFewParticles},
};

// Of the settings that have everything, over shared levels, in units of the peer's primary rays.
struct Everything {
    Mean by_rays, baked;
};

struct Price {
    double none_ms = 0, ms = 0; // means of the cameras
};

class Pricing {
public:
    Pricing(const Options& options, const rt_api& api, TraceRunner& runner, const std::string& file)
        : options_(options), name_(std::filesystem::path(file).stem().string()),
          level_(host::gltf::import_file(file)), soft_level_(level_),
          views_(standing_cameras(level_)), size_(parse_image_size(options.frame_size)),
          memory_(size_.width, size_.height), stage_(make_stage(api, level_)) {
        for (host::Light& light : soft_level_.lights) light.source_radius = kLampRadius;
        soft_stage_.emplace(api, soft_level_, options.threads, RT_LIGHT_PROOFS_KEPT,
                            to_isa(options.isa));
        if (!options.peers.empty())
            peer_.emplace(options.peers, standing_triangles(level_), views_, size_, runner,
                          options.threads);
    }

    nlohmann::json run(Everything& everything) {
        if (peer_) peer_->hold_trials();
        nlohmann::json rows = nlohmann::json::array();
        for (const Setting& setting : kSettings) rows.push_back(row_of(setting, everything));
        return rows;
    }

private:
    FrameStage make_stage(const rt_api& api, const host::Level& level) const {
        return FrameStage(api, level, options_.threads, RT_LIGHT_PROOFS_KEPT, to_isa(options_.isa));
    }

    void make_lit_stage() {
        host::Level level = level_;
        host::light_fog(level, kScatter);
        lit_stage_.emplace(stage_.stage().api(), level, options_.threads, RT_LIGHT_PROOFS_KEPT,
                           to_isa(options_.isa));
        host::Stage& stage = lit_stage_->stage();
        host::set_fog(stage, level, kFog, kAmbient);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
    }

    void show_fog(bool fog) {
        if (fog == has_fog_) return;
        has_fog_ = fog;
        host::Stage& stage = stage_.stage();
        host::set_fog(stage, level_, fog ? kFog : host::Fog(), kAmbient);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
    }

    void show_baked(const Setting& setting) {
        if (!setting.baked || (has_bounced_ == setting.bounced && baked_range_ > 0)) return;
        has_bounced_ = setting.bounced;
        baked_range_ = kOcclusionRange;
        rt_bake_desc desc = rt_default_bake_desc();
        desc.occlusion_range = baked_range_;
        desc.bounces = setting.bounced ? 1 : 0;
        host::Stage& stage = stage_.stage();
        const rt_bake_report report = stage.bake(desc, nullptr);
        stage.check(stage.api().commit_scene(stage.scene(), nullptr, nullptr), "building");
        std::printf("%-16s baked%s: %.1f s, %.1f million rays, %.1f MB\n", name_.c_str(),
                    setting.bounced ? ", bounced light, too" : "", report.bake_ms / 1e3,
                    double(report.rays) / 1e6, double(report.bytes) / 1e6);
    }

    double render(const Setting& setting, const std::vector<rt_particle>& embers, size_t view) {
        if (setting.lit_fog && !lit_stage_) make_lit_stage();
        show_fog(setting.fog);
        show_baked(setting);
        rt_frame_desc frame = memory_.frame(Look::direct);
        frame.max_depth = setting.depth;
        frame.bloom = setting.blooms ? kBloom : 0;
        frame.occlusion_range = setting.occlusion ? kOcclusionRange : 0;
        frame.baked_light = setting.baked;
        frame.tinted_shadows = setting.tinted;
        frame.edge_samples = setting.edge_samples;
        frame.light_block = setting.light_block;
        frame.particles = host::to_array(embers);
        frame.airlight_shadows = setting.airlight_shadows;
        frame.airlight_block = setting.airlight_shadows > 0 ? 2 : 1;
        const FrameStage& stage = setting.soft      ? *soft_stage_
                                  : setting.lit_fog ? *lit_stage_
                                                    : stage_;
        const Seconds seconds = stage.render(frame, views_[view]).seconds;
        return 1e3 * (options_.threads == 1 ? seconds.processor : seconds.wall);
    }

    // In turns, so that what the machine does besides counts for both.
    Price measure(const Setting& setting) {
        const auto embers = host::make_embers(level_, setting.particles, /*seconds=*/0);
        std::vector<std::vector<double>> none_ms(views_.size()), ms(views_.size());
        for (uint32_t pass = 0; pass < options_.passes; ++pass) {
            for (size_t view = 0; view < views_.size(); ++view) {
                if (pass == 0) render(setting, embers, view); // warms up
                none_ms[view].push_back(render(kNone, {}, view));
                ms[view].push_back(render(setting, embers, view));
                if (pass == 0) write(setting, view);
                if (peer_) peer_->run(view);
            }
            if (peer_) peer_->end_pass();
        }
        Price price;
        for (size_t view = 0; view < views_.size(); ++view) {
            price.none_ms += median(none_ms[view]) / double(views_.size());
            price.ms += median(ms[view]) / double(views_.size());
        }
        return price;
    }

    nlohmann::json row_of(const Setting& setting, Everything& everything) {
        const Price price = measure(setting);
        std::printf("%-16s %-26s %8.2f %8.2f %+8.2f", name_.c_str(), setting.name, price.none_ms,
                    price.ms, price.ms - price.none_ms);
        nlohmann::json row = {{"scene", name_},       {"setting", setting.name},
                              {"size", size_.text()}, {"threads", options_.threads},
                              {"frame_ms", price.ms}, {"without_ms", price.none_ms}};
        if (peer_) {
            const double peer_ms = peer_->best().frame_ms;
            std::printf(" %8.2f %6.2f %6.2f", peer_ms, price.none_ms / peer_ms, price.ms / peer_ms);
            row["peer_primary_ms"] = peer_ms;
            row["ratio"] = price.ms / peer_ms;
            if (setting.has_everything() && is_level(name_) && name_ != "hall")
                (setting.baked ? everything.baked : everything.by_rays).add(price.ms / peer_ms);
        }
        std::printf("\n");
        std::fflush(stdout);
        return row;
    }

    void write(const Setting& setting, size_t view) const {
        if (options_.pictures.empty()) return;
        std::string name = name_ + "_" + std::to_string(view) + "_" + setting.name + ".png";
        std::erase(name, ',');
        std::replace(name.begin(), name.end(), ' ', '_');
        host::write_picture_file(std::filesystem::path(options_.pictures) / name, size_.width,
                                 size_.height, memory_.pixels);
    }

    const Options& options_;
    std::string name_;
    host::Level level_, soft_level_;
    std::vector<host::Viewpoint> views_;
    ImageSize size_;
    FrameMemory memory_;
    FrameStage stage_;
    std::optional<FrameStage> soft_stage_, lit_stage_;
    std::optional<FramePeer> peer_;
    bool has_fog_ = false, has_bounced_ = false;
    float baked_range_ = 0;
};

} // namespace

std::string run_features(const Options& options) {
    parse_image_size(options.frame_size); // complains before anything is built
    const host::Plugin plugin(options.library);
    TraceRunner runner(options.threads);
    std::printf("%s a frame, mean of the scene's cameras, without and with\n%-16s %-26s %8s %8s "
                "%8s",
                options.threads == 1 ? "processor time" : "wall time", "scene", "feature",
                "without", "with", "more");
    if (!options.peers.empty()) std::printf(" %8s %6s %6s", "peer ms", "ratio", "with");
    std::printf("\n");
    nlohmann::json rows = nlohmann::json::array();
    Everything everything;
    for (const std::string& file : options.scenes)
        for (nlohmann::json& row : Pricing(options, plugin.api(), runner, file).run(everything))
            rows.push_back(std::move(row));
    if (!options.peers.empty())
        std::printf("\neverything over shared levels, in units of the peer's primary rays, "
                    "geometric mean: %.2f, baked: %.2f\n",
                    everything.by_rays.value(), everything.baked.value());
    return rows.dump();
}

} // namespace peregrine::bench
