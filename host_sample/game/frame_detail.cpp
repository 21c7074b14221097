#include "frame_detail.h"

#include <algorithm>

namespace host::game {

namespace {

constexpr double smoothing = 0.15;
constexpr double least_part = 0.25; // of the time, for the picture, whatever else there is

uint32_t part_of(uint32_t side, double part) {
    return static_cast<uint32_t>(std::max(side * part + 0.5, 1.0));
}

} // namespace

void FrameDetail::update(double frame_ms, const rt_frame_stats& last, double fixed) {
    fixed_ = fixed > 0 ? std::clamp(fixed, 1.0 / 16, 1.0) : 0;
    const double other = std::max(frame_ms - last.frame_ms, 0.0);
    other_ms_ = other_ms_ < 0 ? other : other_ms_ + smoothing * (other - other_ms_);
    governor_.target_ms =
        static_cast<float>(std::max(target_ms - other_ms_, least_part * target_ms));
    last_ = last;
    is_new_ = true;
}

void FrameDetail::describe(Frame& frame) {
    if (fixed_ > 0) {
        frame.traced_width = part_of(frame.width, fixed_);
        frame.traced_height = part_of(frame.height, fixed_);
        return;
    }
    frame.governor = &governor_;
    if (is_new_) frame.last = &last_;
    is_new_ = false;
}

} // namespace host::game
