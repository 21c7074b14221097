#pragma once

#include "geometry/triangle.h"
#include "math/vec.h"

#include <cstdint>
#include <random>
#include <vector>

// Triangles for the tests of all builders.
namespace peregrine::test {

using Triangles = std::vector<geometry::Triangle>;

geometry::Triangle make(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c);

// Coordinates of few bits, so that points with weights i / 64 are exact in double.
class Random {
public:
    explicit Random(uint32_t seed) : random_(seed) {}

    uint32_t below(uint32_t n) { return uint32_t(random_()) % n; }
    float coordinate(uint32_t range) { return float(below(range)) / 1024.0f; }
    math::Vec3 point(uint32_t range) {
        return {coordinate(range), coordinate(range), coordinate(range)};
    }
    math::Vec3d inside(const geometry::Triangle& triangle);

    Triangles soup(uint32_t count, uint32_t size); // none is degenerate

private:
    std::mt19937 random_;
};

Triangles scaled(Triangles triangles, float factor);
Triangles moved(Triangles triangles, const math::Vec3& by);
Triangles grid(uint32_t side);
Triangles needles(uint32_t count);

// |  | |||  each triangle half as large and half as far as the one before, on all axes, and from
// the start again after so many sizes
Triangles series(uint32_t count, uint32_t sizes);

// Staircases of axis-aligned triangles: planes that coincide with others and with cells' borders.
Triangles staircases();

// A small soup at a large distance, as far as rounding leaves it triangles.
Triangles far_soup();

// From the smallest coordinates to large ones, none with coincident vertices: rounding makes such.
struct ScaledSoup {
    float scale;
    Triangles triangles;
};
std::vector<ScaledSoup> soups_of_all_scales();

} // namespace peregrine::test
