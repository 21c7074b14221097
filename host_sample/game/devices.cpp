#include "devices.h"

namespace host::game {

ui::Device describe_desk() {
    return {"Keyboard and mouse",
            "Enter",
            "Esc",
            {{"Walk", "W A S D"},
             {"Look", "Mouse, arrow keys"},
             {"Run", "Shift"},
             {"Crouch", "Ctrl, C"},
             {"Jump", "Space"},
             {"Throw a grenade: hold, let go", "Left mouse button, G"},
             {"Doors and lifts", "E"},
             {"Pause", "Esc, P"},
             {"Screenshot", "F12"}}};
}

ui::Device describe_pad(const pads::Pad& pad) {
    using pads::Button;
    const auto name = [&](Button button) { return std::string(pad.prompts.name(button)); };
    return {pad.name,
            name(Button::south),
            name(Button::east),
            {{"Walk", "Left stick"},
             {"Look", "Right stick"},
             {"Run", name(Button::left_shoulder) + ", " + name(Button::left_stick)},
             {"Crouch", name(Button::east)},
             {"Jump", name(Button::south)},
             {"Throw a grenade: hold, let go", name(Button::right_trigger)},
             {"Doors and lifts", name(Button::west)},
             {"Pause", name(Button::start)},
             {"Options", name(Button::select)}}};
}

} // namespace host::game
