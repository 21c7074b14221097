#include "render_scale.h"

#include <algorithm>
#include <cmath>

namespace host::game {

namespace {

constexpr double least = 6, most = 16; // sixteenths
constexpr double smoothing = 0.15;
constexpr uint32_t settling = 8; // frames until a step is judged
constexpr double slack = 0.7;    // of a step, before it is taken upwards

} // namespace

void RenderScale::update(double frame_ms, double render_ms, double fixed) {
    if (fixed > 0) {
        sixteenths_ = 16 * std::clamp(fixed, 1.0 / 16, 1.0);
        since_ = 0;
        return;
    }
    const double part = since_ == 0 ? 1 : smoothing;
    frame_ms_ += part * (frame_ms - frame_ms_);
    render_ms_ += part * (render_ms - render_ms_);
    if (++since_ < settling || render_ms_ <= 0) return;
    // The time of a picture goes by its pixels; the rest of the frame stays.
    const double room = std::max(target_ms - (frame_ms_ - render_ms_), 0.25 * target_ms);
    const double wanted = sixteenths_ * std::sqrt(room / render_ms_);
    const double change = wanted - sixteenths_;
    if (change > -0.3 && change < 1 + slack) return;
    const double next = std::clamp(std::floor(wanted), least, most);
    if (next == sixteenths_) return;
    sixteenths_ = next;
    since_ = 0;
}

uint32_t RenderScale::side(int pixels) const {
    return static_cast<uint32_t>(std::clamp(pixels * scale(), 1.0, 16384.0));
}

} // namespace host::game
