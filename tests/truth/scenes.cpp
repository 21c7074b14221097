#include "scenes.h"

#include <cmath>

namespace peregrine::truth {
namespace {

Vec3 add(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vec3 scale(const Vec3& a, float s) {
    return {a[0] * s, a[1] * s, a[2] * s};
}

Mesh& mesh_of(Scene& scene, const std::string& material) {
    for (Mesh& mesh : scene.meshes)
        if (mesh.material == material) return mesh;
    return scene.meshes.emplace_back(Mesh{material, {}, {}});
}

// Counter-clockwise from the front.
void add_quad(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

// A hull around a corner and three edges that make a right-handed system.
void add_block(Mesh& mesh, const Vec3& corner, const Vec3& x, const Vec3& y, const Vec3& z) {
    const auto at = [&](int i, int j, int k) {
        return add(corner, add(scale(x, float(i)), add(scale(y, float(j)), scale(z, float(k)))));
    };
    add_quad(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    add_quad(mesh, at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0));
    add_quad(mesh, at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1));
    add_quad(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    add_quad(mesh, at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0));
    add_quad(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
}

void add_box(Mesh& mesh, const Vec3& lower, const Vec3& size) {
    add_block(mesh, lower, {size[0], 0, 0}, {0, size[1], 0}, {0, 0, size[2]});
}

// A prism whose triangle of right angle lies in x and y.
void add_prism(Mesh& mesh, const Vec3& corner, float side, float length) {
    const auto at = [&](float x, float y, float z) { return add(corner, {x, y, z}); };
    const Vec3 a = at(0, 0, 0), b = at(side, 0, 0), c = at(0, side, 0);
    const Vec3 d = at(0, 0, length), e = at(side, 0, length), f = at(0, side, length);
    add_quad(mesh, a, b, e, d);
    add_quad(mesh, a, d, f, c);
    add_quad(mesh, b, c, f, e);
    const auto first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {d, e, f, a, c, b});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first + 3, first + 4, first + 5});
}

// A floor and two walls.
void add_corner(Scene& scene, const std::string& material) {
    Mesh& mesh = mesh_of(scene, material);
    add_quad(mesh, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3});
    add_quad(mesh, {-3, 0, -3}, {3, 0, -3}, {3, 4, -3}, {-3, 4, -3});
    add_quad(mesh, {-3, 0, 3}, {-3, 0, -3}, {-3, 4, -3}, {-3, 4, 3});
}

// The inside of a cube of glowing tiles, no side like another.
void add_checkers(Scene& scene) {
    const Vec3 colors[6] = {{0.9f, 0.3f, 0.2f}, {0.2f, 0.7f, 0.3f}, {0.3f, 0.4f, 0.9f},
                            {0.9f, 0.8f, 0.3f}, {0.7f, 0.3f, 0.8f}, {0.3f, 0.8f, 0.8f}};
    constexpr int kTiles = 6;
    constexpr float kHalf = 4;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool upper = side % 2 != 0;
        for (const bool dark : {false, true}) {
            const std::string name = "tile_" + std::to_string(side) + (dark ? "_dark" : "");
            scene.materials.push_back(
                {name, Material::Kind::glowing, scale(colors[side], dark ? 0.2f : 1), 1.5f, {}});
            Mesh& mesh = mesh_of(scene, name);
            for (int i = 0; i < kTiles; ++i)
                for (int j = 0; j < kTiles; ++j) {
                    if (((i + j) % 2 != 0) != dark) continue;
                    const auto at = [&](int du, int dv) {
                        Vec3 p{};
                        p[size_t(axis)] = upper ? kHalf : -kHalf;
                        p[size_t(u)] = kHalf * (2 * float(i + du) / kTiles - 1);
                        p[size_t(v)] = kHalf * (2 * float(j + dv) / kTiles - 1);
                        return p;
                    };
                    if (upper)
                        add_quad(mesh, at(0, 0), at(0, 1), at(1, 1), at(1, 0));
                    else
                        add_quad(mesh, at(0, 0), at(1, 0), at(1, 1), at(0, 1));
                }
        }
    }
}

Scene lit_by(const char* name, const char* what, float source_radius) {
    Scene scene{name, what, {}, {}, {}, {1.5f, 2.5f, 4}, {-0.3f, 0.8f, -0.5f}, 0.8f, 0};
    scene.materials.push_back({"wall", Material::Kind::matt, {0.8f, 0.7f, 0.5f}, 1.5f, {}});
    scene.materials.push_back({"block", Material::Kind::matt, {0.2f, 0.4f, 0.7f}, 1.5f, {}});
    add_corner(scene, "wall");
    add_box(mesh_of(scene, "block"), {-1, 0, -1}, {0.8f, 1.2f, 0.8f});
    add_box(mesh_of(scene, "block"), {0.6f, 0.8f, -0.6f}, {0.7f, 0.1f, 0.7f});
    scene.lamps.push_back({{0.8f, 3.2f, 0.7f}, 40, source_radius});
    return scene;
}

Scene seen_through(const char* name, const char* what) {
    Scene scene{name, what, {}, {}, {}, {0.4f, 0.5f, 3}, {0, 0, 0}, 0.8f, 16};
    add_checkers(scene);
    return scene;
}

Scene mirrors() {
    Scene scene = seen_through("mirrors", "two mirrors that face each other, and a third");
    scene.materials.push_back({"mirror", Material::Kind::mirror, {}, 1.5f, {}});
    Mesh& mesh = mesh_of(scene, "mirror");
    add_quad(mesh, {-1.5f, -1, -2}, {1.5f, -1, -2.2f}, {1.5f, 1, -2.2f}, {-1.5f, 1, -2});
    add_quad(mesh, {1.6f, -1, 3.4f}, {-1.4f, -1, 3.4f}, {-1.4f, 1, 3.4f}, {1.6f, 1, 3.4f});
    add_quad(mesh, {-1.5f, -1.5f, 1}, {1.5f, -1.5f, 1}, {1.5f, -1.4f, -1}, {-1.5f, -1.4f, -1});
    return scene;
}

Scene slabs() {
    Scene scene = seen_through("slabs", "slabs of coloured glass, seen straight and at 60 degrees");
    scene.materials.push_back(
        {"green", Material::Kind::glass, {1, 1, 1}, 1.5f, {0.1f, 0.6f, 0.2f}});
    Mesh& mesh = mesh_of(scene, "green");
    add_box(mesh, {-1.2f, -0.7f, 0}, {0.9f, 1.4f, 0.4f});
    const float c = std::cos(1.0471976f), s = std::sin(1.0471976f);
    add_block(mesh, {0.3f, -0.7f, 0}, {c, 0, s}, {0, 1.4f, 0}, {-0.4f * s, 0, 0.4f * c});
    return scene;
}

Scene prism() {
    Scene scene = seen_through("prism", "a prism that mirrors all beyond its critical angle");
    scene.materials.push_back({"clear", Material::Kind::glass, {1, 1, 1}, 1.7f, {1, 1, 1}});
    add_prism(mesh_of(scene, "clear"), {-0.7f, -0.7f, -0.5f}, 1.5f, 1.2f);
    return scene;
}

Scene nested() {
    Scene scene = seen_through("nested", "a block of dense red glass within one of blue glass");
    scene.materials.push_back(
        {"outer", Material::Kind::glass, {1, 1, 1}, 1.33f, {0.5f, 0.7f, 0.95f}});
    scene.materials.push_back(
        {"inner", Material::Kind::glass, {1, 1, 1}, 1.33f * 1.2f, {0.9f, 0.3f, 0.2f}});
    add_box(mesh_of(scene, "outer"), {-1, -0.8f, -0.8f}, {2, 1.6f, 1.6f});
    add_box(mesh_of(scene, "inner"), {-0.4f, -0.4f, -0.4f}, {0.9f, 0.8f, 0.7f});
    return scene;
}

Scene panes() {
    Scene scene = seen_through("panes", "two window panes, one behind the other");
    scene.materials.push_back({"pane", Material::Kind::pane, {1, 1, 1}, 1.5f, {1, 1, 1}});
    Mesh& mesh = mesh_of(scene, "pane");
    add_quad(mesh, {-1.2f, -1, 0.5f}, {1, -1, -0.5f}, {1, 1, -0.5f}, {-1.2f, 1, 0.5f});
    add_quad(mesh, {-0.6f, -0.7f, -0.9f}, {1.4f, -0.7f, -0.9f}, {1.4f, 0.9f, -0.9f},
             {-0.6f, 0.9f, -0.9f});
    return scene;
}

// Under a sky that is white all around.
Scene lit_from_everywhere() {
    Scene scene = lit_by("openness", "white light from everywhere, and what keeps it out", 0);
    scene.lamps.clear();
    scene.ambient = 1;
    return scene;
}

} // namespace

std::vector<Scene> scenes() {
    return {lit_by("point", "the shadows of a point light", 0),
            lit_by("sphere", "the soft shadows of a sphere of 15 cm", 0.15f),
            lit_from_everywhere(),
            mirrors(),
            slabs(),
            prism(),
            nested(),
            panes()};
}

} // namespace peregrine::truth
