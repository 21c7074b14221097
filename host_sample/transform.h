#pragma once

#include <glm/glm.hpp>
#include <peregrine/rt.h>

namespace host {

inline rt_transform to_transform(const glm::dmat4& matrix) {
    rt_transform transform = rt_default_transform();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            transform.m[4 * row + column] = matrix[column][row];
    return transform;
}

} // namespace host
