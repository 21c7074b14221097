#pragma once

#include <atomic>
#include <thread>

#include "../stage.h"

namespace host::game {

// Bakes the light between a level's surfaces while the game goes on; commits that come after show
// it. What goes wrong only means that there is none.
class LightBaker {
public:
    explicit LightBaker(const Stage& stage);
    ~LightBaker(); // stops it
    LightBaker(const LightBaker&) = delete;
    LightBaker& operator=(const LightBaker&) = delete;

private:
    std::atomic<bool> stops_ = false;
    std::thread thread_;
};

} // namespace host::game
