#pragma once

#include "ui/menu.h"

namespace host::ui {

// Before a screen that has just appeared: nothing gets through in its first moments, and what was
// down in them has to be let go and pressed anew. So nobody chooses in a screen that came while
// they played.
class Gate {
public:
    static constexpr double quiet = 0.4; // seconds

    // Another screen appears.
    void shut() { *this = {}; }

    // Once a frame. `held` as for Repeater: directions as they are held.
    void pass(MenuInput& held, Pointer& pointer, double seconds);

private:
    bool opening_ = true; // in the frame that a screen appears in
    double age_ = 0.0;
    MenuInput stale_;
    bool stale_pointer_ = false;
};

} // namespace host::ui
