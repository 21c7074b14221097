#pragma once

#include <cstdint>
#include <vector>

#include <peregrine/rt.h>

namespace host {

// What the frames of a run took.
class FrameLog {
  public:
    void add(const rt_frame_stats& stats) {
        m_milliseconds.push_back(stats.frame_ms);
        m_primary += stats.rays_primary;
        m_shadow += stats.rays_shadow;
    }

    uint64_t count() const { return m_milliseconds.size(); }
    double median_ms() const;
    double worst_ms() const;
    double mean_primary() const; // rays a frame
    double mean_shadow() const;
    double mrays_per_second() const; // all rays of a mean frame by the median time

  private:
    std::vector<double> m_milliseconds;
    uint64_t m_primary = 0, m_shadow = 0;
};

} // namespace host
