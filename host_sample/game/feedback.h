#pragma once

#include "pads/manager.h"
#include "simulation.h"

namespace host::game {

// What the pad in the hand does back: it shakes with blasts and hits, and its light tells the
// alarm.
class Feedback {
public:
    void update(pads::PadManager& pads, const Shown& shown, bool vibration);

    static pads::Color light_of(double alarm, bool alarmed);

private:
    void shake(pads::PadManager& pads, pads::PadId pad, const Shown& shown) const;

    pads::PadId pad_ = 0;
    pads::Color color_;
};

} // namespace host::game
