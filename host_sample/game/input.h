#pragma once

#include "desk.h"
#include "pads/manager.h"
#include "settings.h"
#include "ui/menu.h"
#include "ui/screens.h"

namespace host::game {

// What the player wants in a frame, whatever they hold.
struct Intent {
    glm::vec2 walk{0.0f}; // to the right and ahead, at most 1 long
    glm::dvec2 turn{0.0}; // radians to the left, upwards
    uint32_t buttons = 0; // three_cores::Button
    bool pause = false, options = false, screenshot = false;
    ui::MenuInput menu; // directions as they are held
};

// Keyboard, mouse and the pad that was used last to one intent. --help lists the keys.
class Input {
public:
    Input();

    // `pad` may be null. Accepting and going back are presses.
    Intent read(const Desk& desk, const pads::Pad* pad, const PlayerSettings& settings,
                double seconds);

    // Toggles begin anew.
    void reset() { crouched_ = running_ = false; }

    bool uses_pad() const { return pad_ != 0; }
    const ui::Device& device() const { return device_; } // prompts follow it
    const std::string& use_key() const { return use_key_; }

private:
    void choose_device(const Desk& desk, const pads::Pad* pad);
    void read_desk(const Desk& desk, const PlayerSettings& settings, double seconds,
                   Intent& intent) const;
    void read_pad(const pads::Pad& pad, const PlayerSettings& settings, double seconds,
                  Intent& intent);

    bool crouched_ = false, running_ = false; // of a pad, until they are pressed again
    pads::PadId pad_ = 0;                     // 0: keyboard and mouse
    ui::Device device_;
    std::string use_key_;
};

} // namespace host::game
