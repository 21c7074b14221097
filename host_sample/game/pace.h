#pragma once

namespace host::game {

// A frame plays no more than this, so that one that hangs does not skip what happens in it.
constexpr double longest_frame = 0.25; // seconds

// How fast the game's time goes by the clock, over the last few seconds. Less than 1 where frames
// take longer than they may play.
class Pace {
public:
    void add(double passed, double played); // seconds, of a frame
    void reset() { *this = {}; }

    double speed() const { return passed_ > 0.0 ? played_ / passed_ : 1.0; }
    bool is_slow() const { return speed() < 0.95; }

private:
    double passed_ = 0.0, played_ = 0.0; // what is long ago counts less and less
};

} // namespace host::game
