#include "options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <thread>

#include <CLI/CLI.hpp>

#include "error.h"
#include "image_file.h"

#ifndef PEREGRINE_VERSION
#define PEREGRINE_VERSION "0.1.0"
#endif

namespace host {

namespace {

const std::map<std::string, rt_view> views = {
    {"shaded", RT_VIEW_SHADED}, {"normals", RT_VIEW_NORMALS}, {"depth", RT_VIEW_DEPTH},
    {"steps", RT_VIEW_STEPS},   {"light", RT_VIEW_LIGHT},     {"occlusion", RT_VIEW_OCCLUSION}};
const std::map<std::string, rt_isa> isas = {{"auto", RT_ISA_BEST},
                                            {"scalar", RT_ISA_SCALAR},
                                            {"sse4", RT_ISA_SSE4},
                                            {"avx2", RT_ISA_AVX2},
                                            {"avx512", RT_ISA_AVX512}};

const std::map<std::string, rt_structure> structures = {{"auto", RT_STRUCTURE_AUTO},
                                                        {"bvh", RT_STRUCTURE_BVH},
                                                        {"kdtree", RT_STRUCTURE_KDTREE},
                                                        {"bih", RT_STRUCTURE_BIH}};
const std::map<std::string, rt_build_quality> builds = {
    {"balanced", RT_BUILD_BALANCED}, {"fast", RT_BUILD_FAST}, {"best", RT_BUILD_BEST}};

const std::map<std::string, Effects> all_effects = {
    {"plain", Effects::plain}, {"full", Effects::full}, {"rich", Effects::rich}};

const std::map<std::string, peregrine::three_cores::Difficulty> difficulties = {
    {"easy", peregrine::three_cores::Difficulty::easy},
    {"normal", peregrine::three_cores::Difficulty::normal},
    {"hard", peregrine::three_cores::Difficulty::hard}};

constexpr const char* keys_text = R"(
In the game (a gamepad's buttons are listed in its options):
  mouse, arrows    look around
  W A S D          walk; Shift runs, Ctrl or C crouches, Space jumps
  left button, G   hold a grenade; let go to throw it
  E                doors and lifts
  Esc, P           pause
  F12              write a screenshot

With --view-only:
  mouse, arrows    look around (click to capture the mouse, Esc to release it)
  W A S D          move; Shift runs
  Space, Ctrl      up and down while flying
  F                fly or walk
  C, V             next camera, next view (shaded, normals, depth, steps, light, occlusion)
  P, F12           write a screenshot
  Esc              release the mouse; pressed again, quit

Without a display the fly-through of --headless is rendered instead.
Exit status: 0 done, 1 the engine failed, 2 something that was given cannot be used; of --replay and
--bot without a window: 0 won, 3 not won, 4 the replay went astray.)";

template <class T>
const char* find_name(const std::map<std::string, T>& names, T value, const char* otherwise) {
    for (const auto& [name, known] : names)
        if (known == value) return name.c_str();
    return otherwise;
}

template <class T>
T find_value(const std::map<std::string, T>& names, const std::string& name,
             const std::string& option) {
    const auto it = names.find(name);
    if (it != names.end()) return it->second;
    std::string all;
    for (const auto& entry : names) all += (all.empty() ? "" : ", ") + entry.first;
    throw InputError(option + " does not know \"" + name + "\"; it takes one of " + all);
}

bool parse_side(const char* first, const char* last, uint32_t& side) {
    const auto [end, error] = std::from_chars(first, last, side);
    return error == std::errc() && end == last && side >= 1 && side <= 16384;
}

void parse_size(const std::string& text, Options& options) {
    const char* first = text.data();
    const char* last = first + text.size();
    const char* cross = std::find(first, last, 'x');
    if (cross == last || !parse_side(first, cross, options.width)
        || !parse_side(cross + 1, last, options.height))
        throw InputError("--size takes WIDTHxHEIGHT, each from 1 to 16384, not \"" + text + "\"");
}

void parse_fog(const std::string& text, Options& options) {
    const char* const last = text.data() + text.size();
    Fog fog;
    const auto density = std::from_chars(text.data(), last, fog.density);
    const bool has_both = density.ec == std::errc() && density.ptr != last && *density.ptr == ',';
    const auto top = std::from_chars(density.ptr + has_both, last, fog.top);
    const auto is_good = [](float value) { return value >= 0.0f && value <= 1e6f; };
    if (!has_both || top.ec != std::errc() || top.ptr != last || !is_good(fog.density)
        || !is_good(fog.top))
        throw InputError("--fog takes DENSITY,TOP, such as 0.1,2, not \"" + text + "\"");
    options.fog = fog;
}

// The texts of options that need more than CLI11's own parsing.
struct Texts {
    std::string size = "1280x720", view = "shaded", isa, structure = "auto", build = "balanced";
    std::string difficulty, fog, effects;
    uint32_t frames = 0;
};

void declare_game(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("--difficulty", texts.difficulty,
                   "easy, normal or hard [as it was chosen last]");
    app.add_option("--seed", options.seed, "of what is random in a round [another every time]")
        ->check(CLI::Range(uint64_t{0}, (uint64_t{1} << 56) - 1));
    app.add_option("--record", options.record, "file to write the last round to, as a replay");
    app.add_option("--replay", options.replay,
                   "a recorded round to show; with --headless to play as fast as it goes, which "
                   "ends with WON or LOST and the hash of the state");
    app.add_flag("--bot", options.bot, "the program plays; with --headless as fast as it goes");
    app.add_flag("--mute", options.mute, "no sound");
}

void declare_output(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("--size", texts.size, "WIDTHxHEIGHT of the frame, in pixels [1280x720]");
    app.add_option("--scale", options.scale,
                   "frame size as a part of the window's, or of --size without one [game: as its "
                   "options say; else 1]")
        ->check(CLI::Range(0.25, 1.0));
    app.add_option("--frames", texts.frames,
                   "frames to render, then quit [window: until closed; --out: 1; else 24]")
        ->check(CLI::Range(1u, 1000000u));
    app.add_option("--out", options.out,
                   "picture to write, with --headless, PNG, JPEG, BMP or TGA by its name; a %d or "
                   "%04d in its name writes every "
                   "frame: of --camera, or else of the fly-through");
    app.add_flag("--headless", options.headless,
                 "no window: write --out, or else a fly-through of all cameras to out/");
    app.add_option("--threads", options.threads, "threads, 1 to 256 [all cores]")
        ->check(CLI::Range(1u, 256u));
    app.add_option("--view", texts.view,
                   "shaded, normals, depth, steps, light or occlusion [shaded]");
    app.add_option("--stats", options.stats, "JSON file to write measurements to [none]");
    app.add_option("--isa", texts.isa,
                   "auto, scalar, sse4, avx2 or avx512 [$PEREGRINE_ISA, else auto]");
    app.add_option("--structure", texts.structure, "auto, bvh, kdtree or bih [auto]");
    app.add_option("--build", texts.build, "balanced, fast or best [balanced]");
}

void declare_light(CLI::App& app, Options& options) {
    app.add_option("--exposure", options.exposure,
                   "multiplies the light before tone mapping [adapts to the view]")
        ->check(CLI::Range(1e-6, 1e6));
    app.add_option("--ambient", options.ambient, "light from everywhere [0.15; in the game 0.05]")
        ->check(CLI::Range(0.0, 1e6));
    app.add_flag("--no-shadows", options.no_shadows, "lights shine through everything");
    app.add_option(
           "--light-block", options.light_block,
           "with --view-only or --headless: find light in blocks of 4, 8 or 16 pixels [0: at "
           "every pixel]")
        ->check(CLI::IsMember({0, 1, 4, 8, 16}));
    app.add_option("--edges", options.edge_samples,
                   "with --view-only or --headless: rays a pixel where neighbours differ [1]")
        ->check(CLI::Range(1u, 16u));
    app.add_option("--occlusion", options.occlusion_range,
                   "with --view-only or --headless: surfaces nearer than so many metres keep "
                   "ambient light from each other [0]")
        ->check(CLI::Range(0.0f, 1e3f));
    app.add_option("--occlusion-block", options.occlusion_block,
                   "find that in blocks of 4, 8 or 16 pixels, or at every pixel: 1 [8]")
        ->check(CLI::IsMember({1, 4, 8, 16}));
    app.add_option("--lamp-radius", options.lamp_radius,
                   "with --view-only: lights are spheres of so many metres, and shadows soft [0]")
        ->check(CLI::Range(0.0f, 1e3f));
    app.add_option("--emissive-lamps", options.emissive_lamps,
                   "with --view-only or --headless: at most so many lamps that shine as what glows "
                   "does, the strongest [0]")
        ->check(CLI::Range(0u, 4096u));
    app.add_option("--bake", options.bake,
                   "with --view-only: find once how light goes on between standing surfaces, so "
                   "often, and --occlusion (seconds)")
        ->check(CLI::Range(0u, 8u));
    app.add_flag("--light-proofs", options.light_proofs,
                 "with --view-only: prove once what standing lamps see of the level (seconds)");
}

void declare_effects(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("--bloom", options.bloom,
                   "with --view-only or --headless: the part of what is too bright that glows [0]")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--fog", texts.fog,
                   "with --view-only or --headless: DENSITY,TOP of fog, per metre and metres above "
                   "the lowest place of the scene [none]");
    app.add_option(
        "--effects", texts.effects,
        "plain; full: glow, fires, spray and mist where the level has them; rich: ambient "
        "occlusion, too [plain; in the game as its options say]");
    app.add_option("--fog-lamps", options.fog_lamps,
                   "with --view-only or --headless: the part of what fog takes from the light of "
                   "lamps that one sees [0]")
        ->check(CLI::Range(0.0f, 1.0f));
    app.add_option("--fog-shadows", options.fog_shadows,
                   "pieces in which shadows in that are found, at most 32; 0: it has none [8]")
        ->check(CLI::Range(0u, 32u));
    app.add_option("--embers", options.embers,
                   "with --view-only or --headless: particles that rise from the scene's lamps [0]")
        ->check(CLI::Range(0u, 1000000u));
}

void declare(CLI::App& app, Options& options, Texts& texts) {
    app.add_option("--scene", options.scene, "a .glb or .gltf file [content/hall.glb]");
    app.add_flag("--view-only", options.view_only, "look around in the scene; no game");
    declare_game(app, options, texts);
    app.add_option("--camera", options.camera, "name or index of a camera of the scene [0]");
    app.add_option("--animation", options.animation,
                   "name or index of an animation of the scene, or none [all at once]");
    app.add_option("--time", options.time,
                   "seconds into the animation at the first frame: the moment of a single picture "
                   "[0]")
        ->check(CLI::Range(0.0, 1e9));
    app.add_option("--time-step", options.time_step,
                   "seconds from frame to frame without a window [fly-through: 0.2; else 1/30]")
        ->check(CLI::Range(0.0, 1e6));
    declare_output(app, options, texts);
    declare_light(app, options);
    declare_effects(app, options, texts);
    app.add_flag("--list-cameras", options.list_cameras, "print the scene's cameras and quit");
    app.add_flag("--list-pads", options.list_pads,
                 "print the gamepads and how they are read, and quit");
    app.add_option("--pad-map", options.pad_map,
                   "a file that maps buttons and axes of gamepads (docs/gamepads.md) [none]");
    app.add_option("--library", options.library,
                   "the engine, or a manifest that names it [$PEREGRINE_LIBRARY, else beside this "
                   "program]");
    app.add_flag("--quiet", options.quiet, "say nothing but errors");
    app.set_version_flag("--version", std::string("peregrine_play ") + PEREGRINE_VERSION);
    app.footer(keys_text);
}

void interpret_game(const Options& options) {
    const bool unattended = options.bot || !options.replay.empty();
    if (options.bot && !options.replay.empty())
        throw InputError("--bot plays and --replay shows what was played: give one of them");
    if (!options.replay.empty() && (options.seed || options.difficulty))
        throw InputError("a replay has its own seed and difficulty: leave --seed and --difficulty "
                         "out");
    if (options.view_only && (unattended || !options.record.empty()))
        throw InputError("--view-only is no game: leave --bot, --replay and --record out");
    if (unattended && !options.out.empty())
        throw InputError("--out writes pictures of the scene: leave --bot and --replay out");
    if (options.headless && !unattended && !options.record.empty())
        throw InputError("without a window --record needs --bot: nobody else plays");
}

void interpret(const CLI::App& app, const Texts& texts, Options& options) {
    parse_size(texts.size, options);
    if (!texts.fog.empty()) parse_fog(texts.fog, options);
    if (!std::isfinite(options.scale.value_or(1.0f) + options.exposure.value_or(1.0f)
                       + options.ambient.value_or(0.0f)))
        throw InputError("--scale, --exposure and --ambient take finite numbers");
    if (!std::isfinite(options.time + options.time_step.value_or(0.0)))
        throw InputError("--time and --time-step take finite numbers");
    options.view = find_value(views, texts.view, "--view");
    options.structure = find_value(structures, texts.structure, "--structure");
    options.build = find_value(builds, texts.build, "--build");
    if (app.count("--frames") > 0) options.frames = texts.frames;
    options.sized = app.count("--size") > 0;
    if (!texts.difficulty.empty())
        options.difficulty = find_value(difficulties, texts.difficulty, "--difficulty");
    if (!texts.effects.empty())
        options.effects = find_value(all_effects, texts.effects, "--effects");
    const char* variable = std::getenv("PEREGRINE_ISA");
    if (!texts.isa.empty())
        options.isa = find_value(isas, texts.isa, "--isa");
    else if (variable && *variable)
        options.isa = find_value(isas, variable, "PEREGRINE_ISA");
    if (!options.out.empty() && !is_picture_name(options.out))
        throw InputError(
            "--out writes PNG, JPEG, BMP and TGA files: let its name end in .png, .jpg, "
            ".bmp or .tga, not as \""
            + options.out + "\" does");
    if (!options.out.empty() && !options.headless)
        throw InputError("--out needs --headless; in a window, F12 writes a screenshot");
    interpret_game(options);
}

} // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
    CLI::App app("A game, and a viewer of scenes, with the Peregrine ray tracer.",
                 "peregrine_play");
    Options options;
    options.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 256u);
    Texts texts;
    declare(app, options, texts);
    try {
        app.parse(argc, argv);
        interpret(app, texts, options);
    } catch (const CLI::CallForHelp&) {
        return {std::nullopt, app.help(), 0};
    } catch (const CLI::CallForVersion&) {
        return {std::nullopt, app.version() + "\n", 0};
    } catch (const std::exception& error) { // CLI::ParseError or InputError
        return {std::nullopt,
                std::string("peregrine_play: ") + error.what() + " (--help lists the options).\n",
                2};
    }
    return {options, "", 0};
}

const char* isa_name(rt_isa isa) {
    return find_name(isas, isa, "unknown");
}

const char* view_name(rt_view view) {
    return find_name(views, view, "unknown");
}

const char* structure_name(rt_structure structure) {
    return find_name(structures, structure, "unknown");
}

const char* build_name(rt_build_quality quality) {
    return find_name(builds, quality, "unknown");
}

} // namespace host
