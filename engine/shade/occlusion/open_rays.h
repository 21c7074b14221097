#pragma once

#include "math/vec.h"

#include <cstdint>
#include <span>

namespace peregrine::shade {

// A ray that asks how open a place is.
struct OpenRay {
    math::Vec3 direction; // unit; the place's normal is the third axis
    float length;         // in parts of the range
};

inline constexpr uint32_t kMostOpenRays = 256;

// Rays that are distributed like the cosine to the normal, their lengths evenly over the range:
// what is near hides more of them than what is far away. Evenly distributed in all of that (the
// sequence R2 of Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), and the
// same bits everywhere.
class OpenRays {
public:
    // Without `has_end` the range is infinite, and so are all lengths.
    explicit OpenRays(uint32_t count, bool has_end = true);

    std::span<const OpenRay> all() const { return {rays_, count_}; }

private:
    uint32_t count_;
    OpenRay rays_[kMostOpenRays];
};

// Axes about a unit normal that turn with it, all over but opposite to a direction that few
// surfaces have: the least rotation of a fixed frame.
struct TangentFrame {
    math::Vec3 x, y;

    explicit TangentFrame(const math::Vec3& normal);
};

} // namespace peregrine::shade
