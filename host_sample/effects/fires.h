#pragma once

#include <vector>

#include <peregrine/rt.h>

#include "level.h"

namespace host {

// What burns in a level, by the names of its lamps, which stand above their flames: brazier_N,
// torchere_N, sconce_N.
class Fires {
public:
    explicit Fires(const Level& level);

    // Flames that lick and embers that rise, as they are after so many seconds.
    void add(double seconds, std::vector<rt_particle>& particles) const;

    struct Fire {
        uint32_t lamp; // of Level::lights
        Light light;
        float size; // metres, of its flame
        uint32_t tongues, embers;
    };
    const std::vector<Fire>& all() const { return fires_; }

private:
    std::vector<Fire> fires_;
};

// What a lamp of the fire sends out after so many seconds, as a part of what it does on the
// average.
float flicker(const Fires::Fire& fire, double seconds);

} // namespace host
