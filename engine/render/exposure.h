#pragma once

namespace peregrine::render {

// How an eye adapts; see rt_exposure, whose names these are.
struct Eye {
    float key, adaptation;
    float least, most;
    float brighten_seconds, darken_seconds;
    float exposure; // of the last frame; 0: none yet
};

// The exposure after `seconds`, given the mean luminance of what was seen (0: nothing was). It goes
// toward (key / mean)^adaptation as a ratio, so that ten steps of 0.1 s are one of a second.
float adapt(const Eye& eye, float mean, float seconds);

} // namespace peregrine::render
