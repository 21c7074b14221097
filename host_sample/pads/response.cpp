#include "response.h"

#include <algorithm>
#include <cmath>

namespace host::pads {

namespace {

float sane(float value, float lowest, float highest) {
    return value >= lowest ? std::min(value, highest) : lowest; // not a number: lowest
}

} // namespace

float respond(float way, const Response& response) {
    const float inner = sane(response.inner, 0.0f, 0.95f);
    const float outer = sane(response.outer, inner + 0.01f, 1.0f);
    const float curve = sane(response.curve, 0.0f, 1.0f);
    const float t = sane((way - inner) / (outer - inner), 0.0f, 1.0f);
    return sane((1.0f - curve) * t + curve * t * t * t, 0.0f, 1.0f);
}

Stick respond(Stick stick, const Response& response) {
    const float length = std::sqrt(stick.x * stick.x + stick.y * stick.y);
    if (!(length > 0.0f)) return {};
    const float scale = respond(length, response) / length;
    return {std::clamp(stick.x * scale, -1.0f, 1.0f), std::clamp(stick.y * scale, -1.0f, 1.0f)};
}

PadState respond(const PadState& state, const PadResponse& response) {
    PadState result = state;
    result.left = respond(state.left, response.sticks);
    result.right = respond(state.right, response.sticks);
    result.left_trigger = respond(state.left_trigger, response.triggers);
    result.right_trigger = respond(state.right_trigger, response.triggers);
    return result;
}

} // namespace host::pads
