#pragma once

#include <cstdint>

#include <peregrine/rt.h>

#include "durations.h"

namespace host {

// What the frames of a run took.
class FrameLog {
public:
    void add(const rt_frame_stats& stats) {
        times_.add(stats.frame_ms);
        primary_ += stats.rays_primary;
        shadow_ += stats.rays_shadow;
    }

    uint64_t count() const { return times_.count(); }
    double median_ms() const { return times_.median(); }
    double worst_ms() const { return times_.worst(); }
    double mean_primary() const; // rays a frame
    double mean_shadow() const;
    double mrays_per_second() const; // all rays of a mean frame by the median time

private:
    Durations times_;
    uint64_t primary_ = 0, shadow_ = 0;
};

} // namespace host
