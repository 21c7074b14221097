#pragma once

#include "gameplay/character.h"

#include <glm/geometric.hpp>

#include <random>

namespace peregrine::test {

// Keeps an input for some time, then chooses another. By the integers of the generator alone: the
// standard's distributions differ between libraries.
class Wanderer {
public:
    explicit Wanderer(uint32_t seed) : random_(seed) {}

    const gameplay::CharacterInput& next() {
        input_.jump = pick(90) == 0;
        if (left_-- > 0) return input_;
        left_ = int(pick(60));
        const gameplay::Vec3 way(int(pick(2001)) - 1000, 0, int(pick(2001)) - 1000);
        const double length = glm::length(way);
        input_.walk = length > 0 && pick(10) > 0 ? way / length : gameplay::Vec3(0);
        input_.crouch = pick(5) == 0;
        return input_;
    }

private:
    uint32_t pick(uint32_t count) { return uint32_t(random_() % count); }

    std::mt19937 random_;
    gameplay::CharacterInput input_;
    int left_ = 0;
};

} // namespace peregrine::test
