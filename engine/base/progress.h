#pragma once

#include <cstdint>

namespace peregrine::base {

// Told now and then how far long work has come, from the thread that asked for it alone; a return
// other than 0 asks the work to stop.
struct Progress {
    int32_t (*function)(void* user, float fraction) = nullptr;
    void* user = nullptr;

    bool cancels(float fraction) const { return function && function(user, fraction) != 0; }
};

} // namespace peregrine::base
