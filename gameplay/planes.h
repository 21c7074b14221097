#pragma once

#include "gameplay/world.h"

#include <array>

namespace peregrine::gameplay {

// The planes that a motion must not lead into, as it met them one after the other.
class Planes {
public:
    void add(const Vec3& normal);

    // What is left of a motion: along one plane, along the crease of two, or nothing.
    Vec3 clip(const Vec3& motion) const;

private:
    bool leads_into(const Vec3& motion) const;

    std::array<Vec3, 5> normals_;
    size_t count_ = 0;
};

} // namespace peregrine::gameplay
