#pragma once

#include <vector>

#include "level.h"

namespace host {

// A smooth path through viewpoints: Catmull-Rom on positions, slerp on orientations. A single
// viewpoint orbits `center` if it looks at it, as the one that frames the bounds does, and turns
// on the spot otherwise.
class Flight {
public:
    Flight(std::vector<Viewpoint> stops, const glm::dvec3& center, bool orbits);

    Viewpoint at(double fraction) const; // 0 to 1

private:
    std::vector<Viewpoint> stops_;
    glm::dvec3 center_;
    bool orbits_;
};

} // namespace host
