#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <peregrine/rt.h>

#include "gameplay/three_cores/rules.h"

#include "effects/effects.h"

namespace host {

// A layer from the ground up; see rt_fog.
struct Fog {
    float density = 0.0f, top = 0.0f;
};

struct Options {
    std::string scene;               // empty: the default one
    std::string camera;              // a name or an index; empty: the first
    std::string animation;           // a name or an index, "none", or empty: all of them
    double time = 0.0;               // seconds, at the first frame
    std::optional<double> time_step; // seconds from frame to frame without a window
    uint32_t width = 1280, height = 720;
    bool sized = false; // by --size
    std::optional<uint32_t> frames;
    std::string out;
    bool headless = false;
    uint32_t threads = 1;
    rt_view view = RT_VIEW_SHADED;
    std::string stats;
    rt_isa isa = RT_ISA_BEST;
    rt_structure structure = RT_STRUCTURE_AUTO;
    rt_build_quality build = RT_BUILD_BALANCED;
    std::optional<float> exposure; // none: adapts to the view
    std::optional<float> ambient;
    std::optional<float> scale; // none: 1, or in the game as the player has set it
    bool no_shadows = false;
    uint32_t light_block = 0;     // rt_frame_desc::light_block
    uint32_t edge_samples = 1;    // rt_frame_desc::edge_samples
    float occlusion_range = 0.0f; // rt_frame_desc::occlusion_range, ...
    uint32_t occlusion_block = 8;
    bool light_proofs = false;
    std::optional<uint32_t> bake; // bounces, rt_bake_desc::bounces
    float lamp_radius = 0.0f;     // rt_light_desc::source_radius of all lights
    uint32_t emissive_lamps = 0;  // at most, in the place of what glows
    float bloom = 0.0f;           // rt_frame_desc::bloom
    std::optional<Fog> fog;
    float fog_lamps = 0.0f;         // rt_light_desc::fog_scatter of all lamps
    uint32_t fog_shadows = 8;       // rt_frame_desc::airlight_shadows
    std::optional<Effects> effects; // none: plain, or in the game as the player has set it
    uint32_t embers = 0;            // particles above the lamps
    bool list_cameras = false;
    bool list_pads = false;
    std::string pad_map; // a file; see pads/player_mappings.h
    std::string library; // empty: see plugin.h
    bool quiet = false;

    bool view_only = false; // no game
    std::optional<peregrine::three_cores::Difficulty> difficulty;
    std::optional<uint64_t> seed;
    std::string record, replay; // files
    bool bot = false, mute = false;

    // Pictures and looking around are not the game; playing without a window is.
    bool game() const {
        const bool unattended = bot || !replay.empty();
        return !view_only && !list_cameras && (!headless || unattended);
    }
};

// Either options, or a text to print and the status to exit with: 0 for --help and --version, 2
// for a mistake.
struct ParsedOptions {
    std::optional<Options> options;
    std::string text;
    int exit_status = 0;
};

ParsedOptions parse_options(int argc, const char* const* argv);

const char* isa_name(rt_isa isa);
const char* view_name(rt_view view);
const char* structure_name(rt_structure structure);
const char* build_name(rt_build_quality quality);

} // namespace host
