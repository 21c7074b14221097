#include "frame_log.h"

#include <algorithm>

namespace host {

double FrameLog::median_ms() const {
    if (milliseconds_.empty()) return 0.0;
    std::vector<double> sorted = milliseconds_;
    std::sort(sorted.begin(), sorted.end());
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double FrameLog::worst_ms() const {
    return milliseconds_.empty() ? 0.0
                                 : *std::max_element(milliseconds_.begin(), milliseconds_.end());
}

double FrameLog::mean_primary() const {
    return count() == 0 ? 0.0 : static_cast<double>(primary_) / static_cast<double>(count());
}

double FrameLog::mean_shadow() const {
    return count() == 0 ? 0.0 : static_cast<double>(shadow_) / static_cast<double>(count());
}

double FrameLog::mrays_per_second() const {
    const double median = median_ms();
    return median > 0.0 ? (mean_primary() + mean_shadow()) / median * 1e-3 : 0.0;
}

} // namespace host
