// What the buttons are called on the pad that the player holds.
#pragma once

#include "model.h"

namespace host::pads {

enum class PromptStyle : uint8_t { dualshock4, dualsense, nintendo, xbox, generic };

class Prompts {
public:
    explicit Prompts(PromptStyle style = PromptStyle::generic) : style_(style) {}
    explicit Prompts(const Identity& identity);

    PromptStyle style() const { return style_; }
    const char* name(Button button) const;

private:
    PromptStyle style_;
};

} // namespace host::pads
