#pragma once

#include <cstdint>
#include <vector>

#include <peregrine/rt.h>

namespace host {

// What the frames of a run took.
class FrameLog {
public:
    void add(const rt_frame_stats& stats) {
        milliseconds_.push_back(stats.frame_ms);
        primary_ += stats.rays_primary;
        shadow_ += stats.rays_shadow;
    }

    uint64_t count() const { return milliseconds_.size(); }
    double median_ms() const;
    double worst_ms() const;
    double mean_primary() const; // rays a frame
    double mean_shadow() const;
    double mrays_per_second() const; // all rays of a mean frame by the median time

private:
    std::vector<double> milliseconds_;
    uint64_t primary_ = 0, shadow_ = 0;
};

} // namespace host
