#include "ui/gate.h"

namespace host::ui {

namespace {

constexpr bool MenuInput::*inputs[] = {&MenuInput::up,    &MenuInput::down,   &MenuInput::left,
                                       &MenuInput::right, &MenuInput::accept, &MenuInput::back};

} // namespace

void Gate::pass(MenuInput& held, Pointer& pointer, double seconds) {
    if (!opening_) age_ += seconds;
    opening_ = false;
    const bool shut = age_ < quiet;
    for (bool MenuInput::*const input : inputs) {
        stale_.*input = held.*input && (shut || stale_.*input);
        held.*input = held.*input && !(stale_.*input);
    }
    const bool down = pointer.held || pointer.pressed;
    stale_pointer_ = down && (shut || (stale_pointer_ && !pointer.pressed));
    if (stale_pointer_) pointer.pressed = pointer.held = false;
    if (shut) pointer.moved = false;
}

} // namespace host::ui
