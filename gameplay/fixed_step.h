#pragma once

#include <algorithm>
#include <cstdint>

namespace peregrine::gameplay {

// Turns the uneven time of frames into ticks of even length. The game's time is tick over
// ticks_per_second, so that it does not depend on the frames.
class FixedStep {
public:
    // A frame that took long makes at most `most_ticks` ticks; the game is then slower than real
    // time instead of ever further behind.
    explicit FixedStep(uint32_t ticks_per_second, uint32_t most_ticks = 8)
        : rate_(ticks_per_second), most_(most_ticks) {}

    // How many ticks are due after another `seconds` (>= 0).
    uint32_t advance(double seconds) {
        due_ = std::min(due_ + seconds * rate_, double(most_) + 1);
        const uint32_t ticks = std::min(uint32_t(due_), most_);
        due_ = std::min(due_ - ticks, 1.0);
        return ticks;
    }

    // How far the time is on its way from the last tick to the next: to draw in between.
    double blend() const { return due_; }

    double time(uint64_t tick) const { return double(tick) / rate_; }

private:
    uint32_t rate_, most_;
    double due_ = 0; // ticks
};

} // namespace peregrine::gameplay
