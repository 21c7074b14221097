#pragma once

#include <cstdint>

namespace host::game {

// Which part of the window's sides to render, so that frames come about in time. Steps of a
// sixteenth, and not often: the texture that shows the frame stays as it is in between.
class RenderScale {
public:
    static constexpr double target_ms = 1000.0 / 30.0;

    // After a frame that took so long as a whole, `render_ms` of it for the picture. `fixed`: a
    // part that the player chose, or 0.
    void update(double frame_ms, double render_ms, double fixed);

    double scale() const { return sixteenths_ / 16.0; }
    // The side of a picture for a window's side.
    uint32_t side(int pixels) const;

private:
    double sixteenths_ = 9;
    double frame_ms_ = 0, render_ms_ = 0; // smooth
    uint32_t since_ = 0;                  // frames at this scale
};

} // namespace host::game
