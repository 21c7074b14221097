#include "builder_worlds.h"

#include <cmath>

namespace peregrine::test {

using geometry::Triangle;
using math::Vec3;
using math::Vec3d;

namespace {

bool is_degenerate(const Triangle& t) {
    return glm::cross(t.v1 - t.v0, t.v2 - t.v0) == Vec3(0);
}

} // namespace

Triangle make(const Vec3& a, const Vec3& b, const Vec3& c) {
    Triangle triangle{};
    triangle.v0 = a;
    triangle.v1 = b;
    triangle.v2 = c;
    return triangle;
}

Vec3d Random::inside(const Triangle& t) {
    uint32_t u = below(65);
    uint32_t v = below(65);
    if (u + v > 64) u = 64 - u, v = 64 - v;
    return (Vec3d(t.v0) * double(64 - u - v) + Vec3d(t.v1) * double(u) + Vec3d(t.v2) * double(v))
           / 64.0;
}

Triangles Random::soup(uint32_t count, uint32_t size) {
    Triangles triangles;
    while (triangles.size() < count) {
        const Vec3 at = point(32768);
        const Triangle t = make(at + point(size), at + point(size), at + point(size));
        if (!is_degenerate(t)) triangles.push_back(t);
    }
    return triangles;
}

Triangles scaled(Triangles triangles, float factor) {
    for (Triangle& t : triangles) t.v0 *= factor, t.v1 *= factor, t.v2 *= factor;
    return triangles;
}

Triangles moved(Triangles triangles, const Vec3& by) {
    for (Triangle& t : triangles) t.v0 += by, t.v1 += by, t.v2 += by;
    return triangles;
}

Triangles grid(uint32_t side) {
    Triangles triangles;
    for (uint32_t i = 0; i < side * side; ++i) {
        const Vec3 at(float(i % side), 0, float(i / side));
        triangles.push_back(make(at, at + Vec3(1, 0, 0), at + Vec3(0, 0, 1)));
        triangles.push_back(make(at + Vec3(1, 0, 0), at + Vec3(1, 0, 1), at + Vec3(0, 0, 1)));
    }
    return triangles;
}

Triangles needles(uint32_t count) {
    Random random(3);
    Triangles triangles;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 at = random.point(1024);
        triangles.push_back(
            make(at, at + random.point(65536), at + Vec3(1.0f / 1024, 2.0f / 1024, 0)));
    }
    return triangles;
}

Triangles series(uint32_t count, uint32_t sizes) {
    Triangles triangles;
    for (uint32_t i = 0; i < count; ++i) {
        const float s = std::ldexp(1.0f, 60 - int(i % sizes));
        triangles.push_back(make({s, 0, 0}, {s, s, 0}, {s * 1.5f, 0, s}));
    }
    return triangles;
}

Triangles staircases() {
    Triangles triangles;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (const Triangle& t : grid(16)) {
            const auto turn = [&](Vec3 v) {
                for (uint32_t i = 0; i < axis; ++i) v = {v.z, v.x, v.y};
                return v;
            };
            for (uint32_t layer = 0; layer < 4; ++layer) {
                const Vec3 offset = turn({0, float(4 * layer), 0});
                triangles.push_back(
                    make(turn(t.v0) + offset, turn(t.v1) + offset, turn(t.v2) + offset));
            }
        }
    }
    return triangles;
}

Triangles far_soup() {
    Triangles triangles = moved(Random(8).soup(3000, 1024), Vec3(1e6f, -3e6f, 1e5f));
    std::erase_if(triangles, is_degenerate);
    return triangles;
}

std::vector<ScaledSoup> soups_of_all_scales() {
    Random random(5);
    std::vector<ScaledSoup> soups;
    for (float scale : {1e-44f, 1e-38f, 1e-30f, 1e-10f, 1e10f, 1e28f}) {
        Triangles triangles = scaled(random.soup(2000, 1024), scale);
        std::erase_if(triangles, [](const Triangle& t) {
            return t.v0 == t.v1 || t.v1 == t.v2 || t.v2 == t.v0;
        });
        soups.push_back({scale, std::move(triangles)});
    }
    return soups;
}

} // namespace peregrine::test
