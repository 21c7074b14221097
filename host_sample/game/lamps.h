#pragma once

#include <span>
#include <vector>

#include "../stage.h"

namespace host::game {

// As many lights as are wanted at a time. Seen after the next commit.
class LampPool {
public:
    explicit LampPool(Stage& stage) : stage_(stage) {}

    void show(std::span<const rt_light_desc> lamps);

private:
    Stage& stage_;
    std::vector<rt_light> lights_;
};

} // namespace host::game
