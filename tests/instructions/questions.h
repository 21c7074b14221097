#pragma once

#include <peregrine/rt.h>

#include <glm/glm.hpp>
#include <vector>

namespace peregrine::test {

// Fixed sets of questions about the space around some points: the same on every machine.
struct Questions {
    explicit Questions(const std::vector<glm::vec3>& around);

    std::vector<rt_ray> rays;   // long ones, to anywhere
    std::vector<rt_ray> sights; // segments between two of the places
    std::vector<rt_sweep> spheres, capsules;
    std::vector<rt_shape> shapes;
    std::vector<rt_point> points;
};

} // namespace peregrine::test
