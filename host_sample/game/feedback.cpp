#include "feedback.h"

#include <algorithm>

namespace host::game {

namespace {

constexpr pads::Color calm{0, 90, 20}, suspicious{200, 110, 0}, alarmed{255, 0, 0};
constexpr double suspicion_point = 0.3;
constexpr double felt = 14; // metres

} // namespace

pads::Color Feedback::light_of(double alarm, bool is_alarmed) {
    if (is_alarmed) return alarmed;
    return alarm >= suspicion_point ? suspicious : calm;
}

void Feedback::update(pads::PadManager& pads, const Shown& shown, bool vibration) {
    const pads::Pad* pad = pads.active();
    if (!pad) return;
    const pads::Color color = light_of(shown.status.alarm, shown.status.alarmed);
    if (pad->id != pad_ || color != color_) pads.light(pad->id, color);
    pad_ = pad->id;
    color_ = color;
    if (vibration) shake(pads, pad->id, shown);
}

void Feedback::shake(pads::PadManager& pads, pads::PadId pad, const Shown& shown) const {
    double strength = 0;
    bool hurt = false;
    for (const three_cores::Event& event : shown.events) {
        hurt |= event.sound == three_cores::Sound::hurt;
        if (event.sound != three_cores::Sound::blast) continue;
        const double distance = glm::distance(event.point, shown.now.position);
        strength = std::max(strength, 1 - distance / felt);
    }
    if (hurt) strength = 1;
    if (strength <= 0) return;
    const auto way = static_cast<float>(strength);
    pads.rumble(pad, {way, 0.6f * way}, hurt ? 0.5 : 0.35);
}

} // namespace host::game
