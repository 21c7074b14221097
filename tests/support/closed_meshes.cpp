#include "support/closed_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace peregrine::test {

using math::Vec3;

ClosedMesh icosphere(int subdivisions) {
    const float g = (1 + std::sqrt(5.0f)) / 2;
    ClosedMesh mesh{{{-1, g, 0},
                     {1, g, 0},
                     {-1, -g, 0},
                     {1, -g, 0},
                     {0, -1, g},
                     {0, 1, g},
                     {0, -1, -g},
                     {0, 1, -g},
                     {g, 0, -1},
                     {g, 0, 1},
                     {-g, 0, -1},
                     {-g, 0, 1}},
                    {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
    for (int s = 0; s < subdivisions; ++s) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, added] =
                middles.try_emplace(std::minmax(a, b), uint32_t(mesh.vertices.size()));
            if (added) mesh.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
            return at->second;
        };
        std::vector<std::array<uint32_t, 3>> faces;
        for (const auto& [a, b, c] : mesh.faces) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.faces = faces;
    }
    for (Vec3& v : mesh.vertices) v = glm::normalize(v);
    return mesh;
}

// A box of n x n quads a side; shared vertices are equal to the bit.
ClosedMesh box(int n) {
    ClosedMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int a, int b) {
                        Vec3 p;
                        p[axis] = side ? 1.0f : -1.0f;
                        p[(axis + 1) % 3] = -1 + 2 * float(a) / float(n);
                        p[(axis + 2) % 3] = -1 + 2 * float(b) / float(n);
                        mesh.vertices.push_back(p);
                        return uint32_t(mesh.vertices.size() - 1);
                    };
                    const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                                   d = at(i, j + 1);
                    mesh.faces.push_back({a, side ? b : c, side ? c : b});
                    mesh.faces.push_back({a, side ? c : d, side ? d : c});
                }
    return mesh;
}

ClosedMesh uv_sphere(int rings, int sectors) {
    ClosedMesh mesh;
    mesh.vertices = {{0, 1, 0}, {0, -1, 0}};
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            const float a = 3.14159265f * float(i) / float(rings);
            const float b = 6.2831853f * float(j) / float(sectors);
            mesh.vertices.push_back(
                {std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)});
        }
    const auto at = [&](int i, int j) -> uint32_t {
        return i == 0 ? 0 : i == rings ? 1 : uint32_t(2 + (i - 1) * sectors + j % sectors);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) mesh.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            if (i + 1 < rings) mesh.faces.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    return mesh;
}

ClosedMesh torus(int n) {
    ClosedMesh mesh;
    const int m = n / 2;
    const auto turn = [](int i, int count) { return 6.2831853f * float(i) / float(count); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const float a = turn(i, n), b = turn(j, m), r = 1 + 0.4f * std::cos(b);
            mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), 0.4f * std::sin(b)});
        }
    const auto at = [&](int i, int j) { return uint32_t(i % n * m + j % m); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

} // namespace peregrine::test
