#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace peregrine::test {

// The points within `radius` of center + t * direction, 0 <= t <= t_max.
struct Swath {
    math::Vec3d center;
    double radius;
    math::Vec3d direction;
    double t_max;
};

// Lets brute force leave out what is far away: boxes of triangles, asked one by one. They are
// widened by ten thousand times the rounding of what is computed with them.
class TriangleBoxes {
public:
    bool empty() const { return lower_[0].empty(); }
    void add(const math::Vec3d& a, const math::Vec3d& b, const math::Vec3d& c);

    // Adds the numbers of all triangles that may lie in the swath, in order, and of some that do
    // not.
    void find(const Swath& swath, std::vector<uint32_t>& found) const;

private:
    std::vector<float> lower_[3], upper_[3];
    double largest_ = 0; // coordinate
};

} // namespace peregrine::test
