#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include "cameras.h"
#include "effects/mist.h"
#include "error.h"
#include "game/command.h"
#include "headless.h"
#include "loading.h"
#include "options.h"
#include "outputs.h"
#include "pads/linux_hid.h"
#include "pads/listing.h"
#include "pads/player_mappings.h"
#include "plugin.h"
#include "session.h"
#include "stats.h"
#include "stop.h"
#include "viewer.h"
#include "window.h"

namespace host {

namespace {

int list_cameras(const std::vector<Viewpoint>& cameras) {
    for (size_t i = 0; i < cameras.size(); ++i) {
        const Viewpoint& view = cameras[i];
        std::printf("%zu %s at %.2f %.2f %.2f looking along %.2f %.2f %.2f\n", i, view.name.c_str(),
                    view.position.x, view.position.y, view.position.z,
                    static_cast<double>(view.forward.x), static_cast<double>(view.forward.y),
                    static_cast<double>(view.forward.z));
    }
    return 0;
}

// Says how far work is that takes long.
class PercentLine {
public:
    PercentLine(const char* what, bool quiet) : what_(what), quiet_(quiet) {}
    ~PercentLine() {
        if (shown_ >= 0) std::fprintf(stderr, "\r%s 100%%\n", what_);
    }
    void show(float fraction) {
        if (quiet_ || Clock::now() - begin_ < std::chrono::milliseconds(500)) return;
        const int percent = static_cast<int>(100.0f * fraction);
        if (percent == shown_) return;
        std::fprintf(stderr, "\r%s %3d%%", what_, percent);
        shown_ = percent;
    }

private:
    using Clock = std::chrono::steady_clock;

    const char* what_;
    bool quiet_;
    Clock::time_point begin_ = Clock::now();
    int shown_ = -1; // per cent
};

rt_commit_report build(Stage& stage, const Options& options) {
    PercentLine line("building", options.quiet);
    return stage.commit(
        options.structure, options.build, [&](float fraction) { line.show(fraction); },
        options.light_proofs ? RT_LIGHT_PROOFS_MADE : RT_LIGHT_PROOFS_KEPT);
}

void bake(Stage& stage, const Options& options, float occlusion_range) {
    rt_bake_desc desc = rt_default_bake_desc();
    desc.bounces = *options.bake;
    desc.occlusion_range = occlusion_range;
    rt_bake_report report;
    {
        PercentLine line("baking", options.quiet);
        report = stage.bake(desc, [&](float fraction) { line.show(fraction); });
    }
    stage.commit(options.structure, options.build, nullptr);
    if (!options.quiet)
        std::printf("baked %llu points (%.1f MB) with %.1f million rays in %.1f s\n",
                    static_cast<unsigned long long>(report.point_count),
                    static_cast<double>(report.bytes) / 1e6, static_cast<double>(report.rays) / 1e6,
                    report.bake_ms / 1e3);
}

void show(Session& session) {
    const Options& options = session.options;
    if (options.headless) {
        run_headless(session);
        return;
    }
    std::string cause;
    const auto window = Window::open("Peregrine", static_cast<int>(options.width),
                                     static_cast<int>(options.height), false, cause);
    if (window) {
        run_viewer(session, *window);
        return;
    }
    std::cerr << "no window: " << cause << "; rendering a fly-through instead\n";
    run_flight(session, flight_pictures);
}

int list_pads(const Options& options) {
    pads::PlayerMappings mappings;
    if (!options.pad_map.empty()) {
        const std::string mistake = pads::read_player_mappings(options.pad_map, mappings);
        if (!mistake.empty()) throw InputError(mistake);
    }
    pads::LinuxHid hid;
    std::cout << pads::list_pads(hid, mappings);
    return 0;
}

int view(const Options& options) {
    Level level = load_level(options, options.animation);
    for (Light& light : level.lights)
        if (light.source_radius == 0.0f) light.source_radius = options.lamp_radius;
    const bool has_effects = options.effects.value_or(Effects::plain) != Effects::plain;
    if (has_effects) light_mist(level);
    if (options.fog_lamps > 0.0f) light_fog(level, options.fog_lamps);
    auto cameras = usable_cameras(level);
    const size_t camera = find_camera(cameras, options.camera);
    if (options.list_cameras) return list_cameras(cameras);

    const Plugin plugin(options.library);
    Ripples ripples;
    Stage stage(plugin.api(), options.threads, options.isa);
    Player player(stage, level,
                  upload_level(stage, level, options.ambient.value_or(0.15f),
                               has_effects ? ripples.add_to(stage) : rt_program{}));
    if (options.fog) set_fog(stage, level, *options.fog, options.ambient.value_or(0.15f));
    player.describe(options.time);
    LevelEffects effects(stage, level, player.uploaded().lights, !options.fog);
    if (has_effects) effects.describe(options.time, player.follow(cameras[camera]).position);
    const rt_commit_report report = build(stage, options);
    Session session{options, level, std::move(cameras), camera, stage, player, report, {}, 0, 0};
    if (has_effects) {
        session.effects = &effects;
        session.ripples = &ripples;
    }
    if (options.bake) bake(stage, options, session.frame(1, 1).occlusion_range);
    show(session);
    if (!options.stats.empty()) write_stats(options.stats, session);
    return 0;
}

int run(const Options& options) {
    if (options.list_pads) return list_pads(options);
    if (!options.list_cameras) check_outputs(options);
    stop_on_signals();
    if (options.game())
        if (const auto status = game::run(options)) return *status;
    return view(options);
}

int fail(int status, const std::string& sentence) {
    std::cerr << "peregrine_play: " << sentence << "\n";
    return status;
}

} // namespace

} // namespace host

int main(int argc, char** argv) {
    try {
        const host::ParsedOptions parsed = host::parse_options(argc, argv);
        if (parsed.options) return host::run(*parsed.options);
        (parsed.exit_status == 0 ? std::cout : std::cerr) << parsed.text;
        return parsed.exit_status;
    } catch (const host::InputError& error) {
        return host::fail(2, error.what());
    } catch (const std::bad_alloc&) {
        return host::fail(1, "there is not enough memory");
    } catch (const std::exception& error) {
        return host::fail(1, error.what());
    }
}
