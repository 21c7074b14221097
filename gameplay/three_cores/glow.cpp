#include "gameplay/three_cores/glow.h"

#include <glm/geometric.hpp>

namespace peregrine::three_cores {
namespace {

using gameplay::Mood;

constexpr double kBeam = 75, kCore = 3, kBlast = 420; // candela
constexpr double kCoreReach = 4, kBlastReach = 16;    // m
constexpr double kLens = 0.3; // m before the middle of a drone: outside of its hull

Vec3 color_of(Mood mood) {
    switch (mood) {
    case Mood::calm:
        return {0.85, 0.93, 1.0};
    case Mood::suspicious:
        return {1.0, 0.62, 0.16};
    case Mood::alarmed:
        break;
    }
    return {1.0, 0.13, 0.08};
}

Glow shining(const Vec3& place, const Vec3& color, double reach) {
    Glow glow;
    glow.color = color;
    glow.lamp.position = place;
    glow.lamp.radius = reach;
    glow.lamp.candela = luminance(color);
    return glow;
}

} // namespace

Glow beam_of(const Drone& drone, const gameplay::SentryRules& rules) {
    const Vec3 forward = glm::normalize(drone.forward());
    Glow glow =
        shining(drone.position() + kLens * forward, kBeam * color_of(drone.mood()), rules.range);
    glow.lamp.kind = Lamp::Kind::spot;
    glow.lamp.direction = forward;
    glow.lamp.cos_outer = rules.cos_half_angle;
    glow.lamp.cos_inner = 0.5 * (1 + rules.cos_half_angle);
    return glow;
}

// From inside the core, which lets it through.
Glow glow_of_core(const Vec3& place) {
    Glow glow = shining(place, kCore * Vec3(0.35, 0.8, 1.0), kCoreReach);
    glow.casts_shadow = false;
    return glow;
}

Glow glow_of(const Blast& blast, uint64_t now) {
    const double left = 1 - double(now - blast.tick) / double(kBlastTicks);
    return shining(blast.point + Vec3(0, 0.3, 0), left * left * kBlast * Vec3(1.0, 0.72, 0.4),
                   kBlastReach);
}

} // namespace peregrine::three_cores
