#pragma once

#include "pads/manager.h"
#include "ui/screens.h"

// What the player is told about what they hold.
namespace host::game {

ui::Device describe_desk();
ui::Device describe_pad(const pads::Pad& pad);

} // namespace host::game
