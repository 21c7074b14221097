#pragma once

#include "geometry/triangle.h"
#include "math/box.h"
#include "math/ray.h"

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace peregrine::test {

struct Eye {
    math::Vec3 position;
    math::Vec3 forward;
};

struct RaySet {
    std::string name;
    std::vector<math::Ray> rays;
};

// Rays as games and adversaries cast them, the same for the same seed: camera, shadow, random,
// axis-parallel, through vertices, along edges, through edges, extreme, fans, sheaves, parallel, pictures.
// Shadow rays start at random points of triangles.
std::vector<RaySet> make_ray_sets(std::span<const geometry::Triangle> triangles,
                                  std::span<const Eye> eyes, std::span<const math::Vec3> lights,
                                  size_t rays_per_set, uint32_t seed);

} // namespace peregrine::test
