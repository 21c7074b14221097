#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace host {

enum class Property { translation, rotation, scale, weights };
enum class Interpolation { step, linear, cubic };

// The keys of one property of one node. A value has three numbers, or four (x, y, z, w), or one a
// morph target. A cubic key holds three values: the tangent that arrives, the value itself and the
// tangent that leaves.
struct Track {
    uint32_t node = 0;
    Property property = Property::translation;
    Interpolation interpolation = Interpolation::linear;
    uint32_t width = 3;        // numbers of a value
    std::vector<float> times;  // seconds, ascending, not negative; never empty
    std::vector<float> values; // `width` a key, or three times as many
};

struct Clip {
    std::string name;
    double duration = 0.0; // seconds, until the last key of any track
    std::vector<Track> tracks;
};

// Writes the value at a time: `width` numbers, a rotation of unit length. Before the first key and
// after the last, the value is theirs.
void sample(const Track& track, double time, std::span<double> value);

} // namespace host
