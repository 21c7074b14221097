#pragma once

#include <string>
#include <vector>

#include "animation/player.h"
#include "effects/choose.h"
#include "effects/embers.h"
#include "effects/level_effects.h"
#include "effects/ripples.h"
#include "frame_log.h"
#include "level.h"
#include "options.h"
#include "stage.h"
#include "upload.h"

namespace host {

// Everything that showing a scene needs, in a window or without one.
struct Session {
    const Options& options;
    const Level& level;
    std::vector<Viewpoint> cameras; // never empty
    size_t camera = 0;              // the chosen one
    Stage& stage;
    Player& player;
    rt_commit_report report; // of the first commit
    FrameLog log;
    uint32_t width = 0, height = 0;  // of the last frame
    LevelEffects* effects = nullptr; // null: none, ...
    Ripples* ripples = nullptr;      // ... and neither has water waves
    std::vector<rt_particle> particles{};

    // The chosen camera as it is now.
    Viewpoint viewpoint() const { return player.follow(cameras[camera]); }

    void show_moment(double seconds, const glm::dvec3& eye) {
        particles = make_embers(level, options.embers, seconds);
        if (effects) effects->add_particles(seconds, particles);
        if (ripples) ripples->set_time(seconds);
        const bool changed = effects && effects->describe(seconds, eye);
        player.show(seconds, options.structure, options.build, changed);
    }

    // A frame as the options ask for it, 8 bits a channel.
    Frame frame(uint32_t frame_width, uint32_t frame_height) const {
        Frame frame;
        frame.width = frame_width;
        frame.height = frame_height;
        frame.view = options.view;
        frame.no_shadows = options.no_shadows;
        frame.light_block = options.light_block;
        frame.edge_samples = options.edge_samples;
        frame.occlusion_block = options.occlusion_block;
        if (options.effects) choose(*options.effects, frame);
        if (options.bloom > 0.0f) frame.bloom = options.bloom;
        if (options.occlusion_range > 0.0f) frame.occlusion_range = options.occlusion_range;
        if (options.fog_lamps > 0.0f) frame.airlight_shadows = options.fog_shadows;
        frame.particles = to_array(particles);
        const double diagonal = level.bounds.diagonal();
        if (diagonal > 0.0) frame.depth_range = static_cast<float>(diagonal);
        return frame;
    }
};

} // namespace host
