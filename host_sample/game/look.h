#pragma once

#include "gameplay/replay.h"

#include <glm/glm.hpp>

#include "aliases.h"

namespace host::game {

// Where the player looks and which way is ahead. Angles live here; the game gets directions.
class Look {
public:
    void face(const glm::dvec3& forward);
    void turn(const glm::dvec2& radians); // to the left, upwards

    glm::vec3 direction() const; // unit

    // `walk`: to the right and ahead, at most 1 long.
    gameplay::TickInput input(const glm::vec2& walk, uint32_t buttons) const;

private:
    double yaw_ = 0.0, pitch_ = 0.0; // yaw 0 looks along -Z and grows to the left
};

} // namespace host::game
