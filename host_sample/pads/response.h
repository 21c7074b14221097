// From what the hand does to what the game feels: dead zones and response curves.
#pragma once

#include "state.h"

namespace host::pads {

struct Response {
    float inner = 0.12f; // a part of the way that does nothing, [0, 1)
    float outer = 0.95f; // from here on it is the full way, (inner, 1]
    float curve = 0.5f;  // 0: proportional, 1: cubic, which is finer near rest
};

struct PadResponse {
    Response sticks;
    Response triggers{0.05f, 0.98f, 0.0f};
};

// [0, 1] to [0, 1]: continuous, never falling, 0 up to "inner" and 1 from "outer" on. Nonsense in
// the settings is bent to the nearest sense.
float respond(float way, const Response& response);

// The dead zone is round: the direction stays, the length responds.
Stick respond(Stick stick, const Response& response);

PadState respond(const PadState& state, const PadResponse& response);

} // namespace host::pads
