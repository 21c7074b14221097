#include "frame_log.h"

namespace host {

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
