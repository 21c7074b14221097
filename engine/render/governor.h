#pragma once

#include "render/frame.h"

#include <cstdint>
#include <span>

namespace peregrine::render {

// What a level of the governor asks of a frame. The best comes first; each is cheaper than the one
// before.
struct GovernorLevel {
    uint32_t light_block;
    float light_tolerance;
    uint32_t edge_samples;
    float edge_budget;
    uint32_t eighths; // of the frame's sides
    float cost;       // of the level before, in parts of this one: a guess, until it is known
    const char* text;

    // Light, edges and size; leaves the rest.
    void apply_to(Approximations& options, const Extent& extent) const;
};

std::span<const GovernorLevel> governor_levels();

// All that a governor remembers; see rt_governor.
struct Governor {
    static constexpr uint32_t kMostLevels = 16;

    float target_ms = 0;
    uint32_t level = 0;
    uint32_t frames = 0;             // seen at this level
    uint32_t patience = 0;           // frames until a better level is tried; 0: as few as ever
    uint32_t previous = 0;           // the level before, ...
    float previous_ms = 0;           // ... and what its frames took
    float smooth_ms = 0;             // of this level, lately, ...
    float mean_ms = 0;               // ... and over a longer time
    float recent_ms[2] = {};         // the last two frames
    float cost[kMostLevels] = {};    // of a level, in parts of the next one; 0: not learned
    float seen_at[kMostLevels] = {}; // what the next one took then

    // After a frame of this level that took so long. Chooses the level of the next one.
    void observe(double frame_ms);
    // Before the first frame: keeps the level, if it is one.
    void begin();

private:
    void smooth(float ms);
    void learn();
    bool is_learned(uint32_t upper) const;
    float cost_of(uint32_t upper) const;
    void go_to(uint32_t next);
    void go_down(float ms);
    void try_up();
};

} // namespace peregrine::render
