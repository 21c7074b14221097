#pragma once

#include <peregrine/rt.h>

#include "../stage.h"

namespace host::game {

// How fine a frame is rendered, so that frames come in time: by the engine's governor, or of the
// size that the player chose.
class FrameDetail {
public:
    static constexpr double target_ms = 1000.0 / 30.0;

    FrameDetail() { governor_.level = 5; } // of the whole size, without finer edges

    // After a frame that took so long as a whole, with what the engine said of it. `fixed`: a part
    // of the sides that the player chose, or 0.
    void update(double frame_ms, const rt_frame_stats& last, double fixed);

    // What the next frame is to be.
    void describe(Frame& frame);

    const rt_governor& governor() const { return governor_; }

private:
    rt_governor governor_ = rt_default_governor();
    rt_frame_stats last_ = rt_default_frame_stats();
    bool is_new_ = false; // `last_`: the governor has not seen it
    double fixed_ = 0;
    double other_ms_ = -1; // what a frame takes beside its picture, smooth; < 0: unknown
};

} // namespace host::game
