#pragma once

#include "math/vec.h"

#include <cstdint>
#include <span>

namespace peregrine::shade {

// Six points at the rim of a ball of radius 1, on its axes. From wherever it is seen, whatever cuts
// its disc is likely to come between two of them.
inline constexpr uint32_t kSphereProbes = 6;
std::span<const math::Vec3, kSphereProbes> sphere_probes();

// Points of the ball of which any number, seen from anywhere, fill its disc evenly, and whose mean
// is its centre if their number is even: one coordinate less of points that are even on the sphere
// of four dimensions (Marsaglia, "Choosing a Point from the Surface of a Sphere", 1972), from the
// sequence R4 (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
inline constexpr uint32_t kMostSpherePoints = 256;
std::span<const math::Vec3, kMostSpherePoints> sphere_points();

} // namespace peregrine::shade
