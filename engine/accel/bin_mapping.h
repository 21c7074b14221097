#pragma once

#include "accel/reference.h"

#include <algorithm>
#include <limits>

namespace peregrine::accel {

// So that no area overflows, nor vanishes.
inline float scale_of(const Bounds& bounds) {
    const Floats size = bounds.upper - bounds.lower;
    const float largest = std::max(std::max(size[0], size[1]), size[2]);
    return largest > 0 ? std::min(1 / largest, std::numeric_limits<float>::max()) : 0;
}

// Which bin a centre is in, on each axis.
class BinMapping {
public:
    BinMapping(const Bounds& centers, uint32_t bins) : origin_(centers.lower) {
        for (int axis = 0; axis < 3; ++axis) {
            const float size = centers.upper[axis] - centers.lower[axis];
            scale_[axis] =
                size > 0 ? std::min(float(bins) / size, std::numeric_limits<float>::max()) : 0;
            last_[axis] = float(bins - 1);
        }
    }
    Ints operator()(const Floats& doubled_center) const {
        return __builtin_convertvector(min((doubled_center - origin_) * scale_, last_), Ints);
    }

private:
    Floats origin_;
    Floats scale_ = {};
    Floats last_ = {};
};

} // namespace peregrine::accel
