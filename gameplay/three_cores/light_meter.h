#pragma once

#include "gameplay/three_cores/glow.h"

#include <span>
#include <vector>

namespace peregrine::three_cores {

// How much light falls on a place, from the lamps that are seen from there: 0 in the dark, towards
// 1 in the light.
class LightMeter {
public:
    explicit LightMeter(std::span<const Lamp> lamps) : lamps_(lamps.begin(), lamps.end()) {}

    // `glows`: what shines now beside the lamps.
    double measure(const gameplay::World& world, const Vec3& place, std::span<const Glow> glows);

private:
    void add(const Lamp& lamp, const Vec3& place);

    std::vector<Lamp> lamps_;

    // The batch, kept for its memory.
    std::vector<Vec3> from_, to_;
    std::vector<double> lux_;
    std::vector<uint8_t> clear_;
};

} // namespace peregrine::three_cores
