#include "support/adversaries.h"

#include <algorithm>
#include <random>
#include <utility>

namespace peregrine::test {

using math::Vec3;

std::vector<geometry::Triangle> lattice() {
    TriangleList list;
    for (int axis = 0; axis < 3; ++axis)
        for (int layer = 0; layer < 4; ++layer)
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) {
                    const auto at = [&](int a, int b) {
                        Vec3 p;
                        p[axis] = float(layer);
                        p[(axis + 1) % 3] = float(a);
                        p[(axis + 2) % 3] = float(b);
                        return p;
                    };
                    list.add(at(i, j), at(i + 1, j), at(i, j + 1));
                    list.add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                }
    return list.triangles;
}

std::vector<geometry::Triangle> coincident(int count) {
    TriangleList list;
    for (int i = 0; i < count; ++i) list.add({0, 0, 0}, {1, 0, float(i % 3)}, {0, 1, float(i % 5)});
    return list.triangles;
}

std::vector<geometry::Triangle> two_sided(int count) {
    TriangleList list;
    std::mt19937 random(9);
    std::vector<geometry::Triangle> all = soup(14, size_t(count), 0.4f);
    for (int i = 0; i < count; ++i) {
        geometry::Triangle other = all[size_t(i)];
        std::swap(other.v1, other.v2);
        all.push_back(other);
    }
    std::shuffle(all.begin(), all.end(), random);
    for (const geometry::Triangle& triangle : all) list.add(triangle.v0, triangle.v1, triangle.v2);
    return list.triangles;
}

std::vector<geometry::Triangle> needles(int count) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(-1, 1);
    TriangleList list;
    for (int i = 0; i < count; ++i) {
        const Vec3 d(unit(random), unit(random), unit(random));
        list.add(-1000.0f * d, 1000.0f * d,
                 1000.0f * d + 1e-4f * Vec3(unit(random), unit(random), unit(random)));
    }
    return list.triangles;
}

} // namespace peregrine::test
