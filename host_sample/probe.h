#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "stage.h"

namespace host {

struct Contact {
    double distance = 0.0;
    glm::dvec3 normal{0.0}; // unit, towards the ray's origin
};

// Asks the scene what lies in a direction.
class Probe {
public:
    explicit Probe(const Stage& stage) : stage_(stage) {}

    // The first surface within `reach` metres of the origin; `direction` is of unit length.
    std::optional<Contact> cast(const glm::dvec3& origin, const glm::dvec3& direction,
                                double reach) const;

private:
    const Stage& stage_;
};

} // namespace host
