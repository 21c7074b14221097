#include "prompts.h"

#include "eightbitdo.h"

namespace host::pads {

namespace {

using Names = std::array<const char*, button_count>; // in the order of Button

constexpr Names dualshock4 = {"Cross", "Circle", "Square",  "Triangle", "L1",   "R1", "L2",
                              "R2",    "Share",  "Options", "PS",       "L3",   "R3", "Up",
                              "Down",  "Left",   "Right",   "Touchpad", "Extra"};
constexpr Names dualsense = {"Cross", "Circle", "Square",  "Triangle", "L1",  "R1", "L2",
                             "R2",    "Create", "Options", "PS",       "L3",  "R3", "Up",
                             "Down",  "Left",   "Right",   "Touchpad", "Mute"};
constexpr Names nintendo = {"B",    "A",     "Y",     "X",        "L",          "R",           "ZL",
                            "ZR",   "Minus", "Plus",  "Home",     "Left Stick", "Right Stick", "Up",
                            "Down", "Left",  "Right", "Touchpad", "Capture"};
constexpr Names xbox = {"A",    "B",    "X",     "Y",        "LB",         "RB",          "LT",
                        "RT",   "View", "Menu",  "Xbox",     "Left Stick", "Right Stick", "Up",
                        "Down", "Left", "Right", "Touchpad", "Share"};
constexpr Names generic = {"Lower Button", "Right Button", "Left Button", "Upper Button", "L1",
                           "R1",           "L2",           "R2",          "Select",       "Start",
                           "Home",         "Left Stick",   "Right Stick", "Up",           "Down",
                           "Left",         "Right",        "Touchpad",    "Extra"};

PromptStyle style_of(const Identity& identity) {
    switch (family_of(identity)) {
    case Family::dualshock4:
        return PromptStyle::dualshock4;
    case Family::dualsense:
        return PromptStyle::dualsense;
    case Family::switch_pro:
        return PromptStyle::nintendo;
    case Family::xbox:
        return PromptStyle::xbox;
    case Family::eightbitdo:
        return eightbitdo_has_xbox_letters(identity.product) ? PromptStyle::xbox
                                                             : PromptStyle::nintendo;
    case Family::generic:
        return PromptStyle::generic;
    }
    return PromptStyle::generic;
}

} // namespace

Prompts::Prompts(const Identity& identity) : style_(style_of(identity)) {}

const char* Prompts::name(Button button) const {
    const auto at = static_cast<size_t>(button);
    switch (style_) {
    case PromptStyle::dualshock4:
        return dualshock4[at];
    case PromptStyle::dualsense:
        return dualsense[at];
    case PromptStyle::nintendo:
        return nintendo[at];
    case PromptStyle::xbox:
        return xbox[at];
    case PromptStyle::generic:
        return generic[at];
    }
    return generic[at];
}

} // namespace host::pads
