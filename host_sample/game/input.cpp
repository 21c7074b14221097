#include "input.h"

#include <algorithm>

#include "gameplay/three_cores/rules.h"

#include "devices.h"
#include "pads/response.h"

namespace host::game {

namespace {

using pads::Button;

constexpr double radians_per_pixel = 0.0022;
constexpr double key_turn = 1.8;       // radians a second, of the arrow keys
constexpr double stick_turn = 3.2;     // of a stick that is held fully
constexpr double stick_pitch = 0.6;    // looking up and down is finer work
constexpr float trigger_point = 0.35f; // a trigger counts as pressed
constexpr float stick_point = 0.5f;    // a stick counts as a direction in a menu
constexpr float standing = 0.2f;       // a stick at rest ends a run
constexpr float least_motion = 3.0f;   // pixels: a table that shakes does not use the mouse

bool is_used(const Desk& desk) {
    return desk.pressed.any() || glm::length(desk.motion) > least_motion;
}

bool is_used(const pads::Pad& pad) {
    const pads::PadState state = pads::respond(pad.state, {});
    const auto moved = [](const pads::Stick& stick) {
        return glm::length(glm::vec2(stick.x, stick.y)) > standing;
    };
    return pad.pressed.any() || moved(state.left) || moved(state.right);
}

// Mouse, then stick or keys: both at once are allowed.
glm::dvec2 aimed(const glm::dvec2& turn, const PlayerSettings& settings) {
    return settings.sensitivity * glm::dvec2(turn.x, settings.invert_look ? -turn.y : turn.y);
}

} // namespace

Input::Input() : device_(describe_desk()), use_key_("E") {}

Intent Input::read(const Desk& desk, const pads::Pad* pad, const PlayerSettings& settings,
                   double seconds) {
    choose_device(desk, pad);
    Intent intent;
    read_desk(desk, settings, seconds, intent);
    if (pad) read_pad(*pad, settings, seconds, intent);
    const float length = glm::length(intent.walk);
    if (length > 1.0f) intent.walk /= length; // diagonals are no faster
    return intent;
}

void Input::choose_device(const Desk& desk, const pads::Pad* pad) {
    pads::PadId chosen = pad_;
    if (!pad || is_used(desk))
        chosen = 0;
    else if (is_used(*pad))
        chosen = pad->id;
    if (chosen == pad_) return;
    pad_ = chosen;
    device_ = pad_ ? describe_pad(*pad) : describe_desk();
    use_key_ = pad_ ? pad->prompts.name(Button::west) : "E";
}

void Input::read_desk(const Desk& desk, const PlayerSettings& settings, double seconds,
                      Intent& intent) const {
    const auto down = [&](Key key) { return desk.held.has(key) || desk.pressed.has(key); };
    const auto press = [&](bool pressed, three_cores::Button button) {
        if (pressed) intent.buttons |= button;
    };
    intent.walk = {desk.axis(Key::d, Key::a), desk.axis(Key::w, Key::s)};
    const glm::dvec2 arrows(desk.axis(Key::left, Key::right), desk.axis(Key::up, Key::down));
    intent.turn = aimed(
        -radians_per_pixel * glm::dvec2(desk.motion) + (key_turn * seconds) * arrows, settings);
    press(down(Key::shift), three_cores::kRun);
    press(down(Key::control) || down(Key::c), three_cores::kCrouch);
    press(down(Key::space), three_cores::kJump);
    press(down(Key::mouse) || down(Key::g), three_cores::kThrow);
    press(down(Key::e), three_cores::kUse);
    intent.pause = desk.pressed.has(Key::escape) || desk.pressed.has(Key::p);
    intent.screenshot = desk.pressed.has(Key::f12);
    intent.menu.up = down(Key::up) || down(Key::w);
    intent.menu.down = down(Key::down) || down(Key::s);
    intent.menu.left = down(Key::left) || down(Key::a);
    intent.menu.right = down(Key::right) || down(Key::d);
    intent.menu.accept = desk.pressed.has(Key::enter) || desk.pressed.has(Key::space);
    intent.menu.back = desk.pressed.has(Key::escape);
}

void Input::read_pad(const pads::Pad& pad, const PlayerSettings& settings, double seconds,
                     Intent& intent) {
    const pads::PadState state = pads::respond(pad.state, {});
    const auto down = [&](Button button) {
        return state.buttons.has(button) || pad.pressed.has(button);
    };
    const auto press = [&](bool pressed, three_cores::Button button) {
        if (pressed) intent.buttons |= button;
    };
    const glm::vec2 walk(state.left.x, state.left.y);
    intent.walk += walk;
    intent.turn +=
        aimed(glm::dvec2(-state.right.x, stick_pitch * static_cast<double>(state.right.y))
                  * (stick_turn * seconds),
              settings);
    if (pad.pressed.has(Button::east)) crouched_ = !crouched_;
    if (pad.pressed.has(Button::left_stick)) running_ = true;
    if (glm::length(walk) < standing) running_ = false;
    const bool run = running_ || down(Button::left_shoulder);
    if (run) crouched_ = false;
    press(run, three_cores::kRun);
    press(crouched_, three_cores::kCrouch);
    press(down(Button::south), three_cores::kJump);
    press(down(Button::right_trigger) || state.right_trigger > trigger_point, three_cores::kThrow);
    press(down(Button::west), three_cores::kUse);
    intent.pause |= pad.pressed.has(Button::start);
    intent.options |= pad.pressed.has(Button::select);
    intent.menu.up |= down(Button::up) || walk.y > stick_point;
    intent.menu.down |= down(Button::down) || walk.y < -stick_point;
    intent.menu.left |= down(Button::left) || walk.x < -stick_point;
    intent.menu.right |= down(Button::right) || walk.x > stick_point;
    intent.menu.accept |= pad.pressed.has(Button::south);
    intent.menu.back |= pad.pressed.has(Button::east);
}

} // namespace host::game
