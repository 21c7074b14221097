#pragma once

#include "gameplay/three_cores/drone.h"

// What shines beside the level's own lamps: one description for the picture and for the light
// meter, so that what is lit in the one is lit in the other.
namespace peregrine::three_cores {

struct Glow {
    Lamp lamp;     // its candela are the luminance of `color`
    Vec3 color{0}; // candela, linear RGB
    bool casts_shadow = true;
};

struct Blast {
    Vec3 point{0};
    uint64_t tick = 0; // that it went off in
};

constexpr uint64_t kBlastTicks = 24; // how long it shines

// A drone's view: what it can see by is lit as far as it sees.
Glow beam_of(const Drone& drone, const gameplay::SentryRules& rules);
Glow glow_of_core(const Vec3& place);
Glow glow_of(const Blast& blast, uint64_t now);

} // namespace peregrine::three_cores
