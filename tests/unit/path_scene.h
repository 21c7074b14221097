#pragma once

#include "render_scene.h"

#include <cmath>

// Materials and places for tests of mirrors and glass.
namespace peregrine::test {

using math::Vec3;
using render::Camera;
using render::Frame;

inline constexpr double kDegree = 0.017453292519943295;

inline scene::Material black() {
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.double_sided = true;
    return material;
}

inline scene::Material mirror(float reflectivity, const Vec3& color = Vec3(1)) {
    scene::Material material = black();
    material.reflectivity = reflectivity;
    material.reflection_color = color;
    return material;
}

inline scene::Material glass(float index = 1.5f) {
    scene::Material material;
    material.transmission = 1;
    material.index_of_refraction = index;
    return material;
}

inline scene::Material pane() {
    scene::Material material = glass();
    material.thin = true;
    material.double_sided = true;
    return material;
}

// Faces outward.
inline void add_box(RenderScene& world, const Vec3& lower, const Vec3& upper,
                    base::Handle material) {
    const auto mesh = world.make_mesh(material);
    for (int i = 0; i < 8; ++i)
        mesh.data->positions.push_back(
            {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    mesh.surface->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                               {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    world.scene.meshes.insert({mesh.data});
}

// A horizontal square about (0, y, 0).
inline void add_floor(RenderScene& world, float size, float y, base::Handle material) {
    world.add_quad({-size, y, size}, {size, y, size}, {size, y, -size}, {-size, y, -size},
                   material);
}

// One that glows, green and blue everywhere alike, red from 0 to 1 as x goes from -size to size.
inline void add_ruler(RenderScene& world, float size, float y) {
    constexpr uint32_t kTexels = 8192;
    std::vector<float> texels;
    for (uint32_t i = 0; i < kTexels; ++i)
        texels.insert(texels.end(), {(float(i) + 0.5f) / kTexels, 1, 1, 1});
    add_floor(world, size, y,
              world.add(glowing(Vec3(1)), {}, {}, world.add_texture(kTexels, 1, texels)));
}

// What the ruler says of a pixel: x, whatever the light has lost.
inline double read_ruler(const Vec3& color, double size) {
    return (2.0 * double(color.x) / double(color.y) - 1.0) * size;
}

// In the plane z = 0, from the downward vertical toward +x.
inline Camera looking(const math::Vec3d& position, double angle) {
    Camera camera;
    camera.position = position;
    camera.forward = {float(std::sin(angle)), float(-std::cos(angle)), 0};
    camera.up = {0, 0, -1};
    camera.vertical_fov = 0.02f;
    return camera;
}

inline Frame frame_of(uint32_t size, uint32_t depth) {
    Frame frame = float_frame(size, size);
    frame.bounces.max_depth = depth;
    return frame;
}

// The middle of a small picture.
inline Vec3 see(RenderScene& world, const Camera& camera, uint32_t depth) {
    return take_picture(world, camera, frame_of(5, depth)).at(2, 2);
}

} // namespace peregrine::test
