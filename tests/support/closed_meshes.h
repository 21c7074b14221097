#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace peregrine::test {

// A surface without a border, its counter-clockwise sides outward; corners that meet are equal to
// the bit.
struct ClosedMesh {
    std::vector<math::Vec3> vertices;
    std::vector<std::array<uint32_t, 3>> faces;
};

ClosedMesh icosphere(int subdivisions);       // of radius 1
ClosedMesh box(int n);                        // of n x n quads a side, from -1 to 1
ClosedMesh uv_sphere(int rings, int sectors); // of radius 1, poles on y
ClosedMesh torus(int n);                      // n times n / 2 quads, of radii 1 and 0.4, around z

} // namespace peregrine::test
