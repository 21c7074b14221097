#include "glass_scene.h"

#include <vector>

namespace peregrine::test {
namespace {

using glm::dvec3;
using glm::vec3;

void copy(const vec3& from, float* to) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

rt_material_desc matt(const vec3& color) {
    rt_material_desc desc = rt_default_material_desc();
    copy(color, desc.base_color);
    desc.double_sided = 1;
    return desc;
}

rt_material_desc mirror(float reflectivity, const vec3& color) {
    rt_material_desc desc = matt(vec3(0.02f));
    desc.reflectivity = reflectivity;
    copy(color, desc.reflection_color);
    return desc;
}

rt_material_desc glass(float index) {
    rt_material_desc desc = rt_default_material_desc();
    desc.transmission = 1;
    desc.index_of_refraction = index;
    return desc;
}

Shape boxed(const vec3& center, float size) {
    Shape box = make_box();
    for (vec3& position : box.positions) position = center + position * size;
    return box;
}

} // namespace

GlassScene::GlassScene(host::Stage& stage, const dvec3& origin)
    : stage_(stage), api_(stage.api()), origin_(origin) {
    stage_.check(api_.set_world_origin(stage_.scene(), &origin_.x), "setting the origin");
    add_room();
    add_glass();
    add_box();
    add_veil();
    add_lights();
    rt_environment environment = rt_default_environment();
    copy({0.06f, 0.07f, 0.09f}, environment.ambient);
    environment.sky = RT_SKY_GRADIENT;
    copy({0.12f, 0.25f, 0.6f}, environment.zenith);
    copy({0.7f, 0.8f, 0.9f}, environment.horizon);
    copy({0.25f, 0.2f, 0.15f}, environment.ground);
    stage_.check(api_.set_environment(stage_.scene(), &environment), "setting the environment");
}

rt_material GlassScene::add(const rt_material_desc& desc) {
    rt_material material;
    stage_.check(api_.add_material(stage_.scene(), &desc, &material), "adding a material");
    return material;
}

rt_mesh GlassScene::add(const Shape& shape, const rt_material_desc& material) {
    rt_mesh_desc desc = shape.desc();
    desc.material = add(material);
    rt_mesh mesh;
    stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding a mesh");
    return mesh;
}

rt_texture GlassScene::add_tiles() {
    std::vector<uint8_t> bytes;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool dark = (x / 4 + y / 4) % 2 != 0;
            const int shade = dark ? 60 : 210;
            for (const int k : {0, 1, 2})
                bytes.push_back(uint8_t(shade + (x * 7 + y * 3 + k * 5) % 24));
            bytes.push_back(255);
        }
    rt_texture_desc desc = rt_default_texture_desc();
    desc.format = RT_FORMAT_RGBA8_SRGB;
    desc.width = desc.height = 16;
    desc.pixels = bytes.data();
    rt_texture texture;
    stage_.check(api_.add_texture(stage_.scene(), &desc, &texture), "adding a texture");
    return texture;
}

void GlassScene::add_room() {
    rt_material_desc floor = matt(vec3(0.8f));
    floor.base_color_texture.texture = add_tiles();
    floor.base_color_texture.transform[0] = floor.base_color_texture.transform[4] = 3;
    floor.reflectivity = 0.06f;
    copy(vec3(0.2f), floor.specular);
    add(make_grid({-4, 0, 4}, {8, 0, 0}, {0, 0, -10}, 1), floor);
    add(make_grid({-4, 0, -6}, {0, 3, 0}, {0, 0, 10}, 1), mirror(0.9f, {0.95f, 0.9f, 0.8f}));
    const rt_material_desc wall = matt({0.75f, 0.4f, 0.3f});
    add(make_grid({-4, 0, -6}, {8, 0, 0}, {0, 0.8f, 0}, 1), wall);
    add(make_grid({4, 0, 4}, {0, 0, -10}, {0, 3, 0}, 2), matt({0.3f, 0.45f, 0.6f}));
    rt_material_desc pane = glass(1.5f);
    pane.thin = pane.double_sided = 1;
    for (int i = 0; i < 4; ++i) {
        copy(i % 2 ? vec3(0.9f, 0.35f, 0.3f) : vec3(0.95f), pane.base_color);
        add(make_grid({-4 + 2 * float(i) + 0.05f, 0.8f, -6}, {1.9f, 0, 0}, {0, 2.2f, 0}, 1), pane);
    }
    rt_material_desc glow = matt(vec3(0));
    copy({3, 2, 0.6f}, glow.emissive);
    add(make_ball({-1.6f, 0.5f, -8}, 0.5f, 4), glow);
    add(make_ball({-1.5f, 0.45f, -3.6f}, 0.45f, 4), matt({0.8f, 0.7f, 0.1f}));
}

void GlassScene::add_glass() {
    add(make_ball({0.5f, 0.95f, -2.4f}, 0.9f, 8), glass(1.5f));
    rt_material_desc core = glass(1.8f);
    copy({0.9f, 0.3f, 0.4f}, core.attenuation_color);
    core.attenuation_distance = 0.3f;
    add(make_ball({0.6f, 1.1f, -2.3f}, 0.35f, 4), core);
    rt_material_desc die = glass(1.45f);
    copy({0.2f, 0.8f, 0.4f}, die.attenuation_color);
    die.attenuation_distance = 0.6f;
    add(boxed({-1.3f, 0.45f, -1}, 0.4f), die);
}

void GlassScene::add_box() {
    rt_material_desc gold = mirror(0.9f, {1, 0.78f, 0.34f});
    gold.double_sided = 0;
    const Shape box = make_box();
    rt_mesh_desc desc = box.desc();
    desc.material = add(gold);
    stage_.check(api_.add_rigid_mesh(stage_.scene(), &desc, &box_), "adding the box");
    place({0.4, 0, -0.3, 0, 0.5, 0, 0.3, 0, 0.4}, {2.4, 0.55, -2.8});
}

// Denser upward.
void GlassScene::add_veil() {
    std::vector<uint8_t> bytes;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (const int value : {200, 160 + 8 * x, 255, x % 2 && y % 2 ? 0 : 230 - 24 * y})
                bytes.push_back(uint8_t(value));
    rt_texture_desc desc = rt_default_texture_desc();
    desc.format = RT_FORMAT_RGBA8_SRGB;
    desc.width = desc.height = 8;
    desc.filter = RT_FILTER_NEAREST;
    desc.pixels = bytes.data();
    rt_material_desc veil = matt(vec3(1));
    veil.alpha_mode = RT_ALPHA_BLEND;
    stage_.check(api_.add_texture(stage_.scene(), &desc, &veil.base_color_texture.texture),
                 "adding a texture");
    add(make_grid({0.9f, 0.9f, -0.6f}, {1.2f, 0, -0.3f}, {0, -0.8f, 0}, 1), veil);
}

void GlassScene::move() {
    place({0.5, 0.1, 0, -0.1, 0.5, 0, 0, 0, -0.5}, {2.2, 0.8, -2});
}

void GlassScene::shine_through() {
    rt_light_desc lamp = rt_default_light_desc();
    rt_light light;
    const auto place_lamp = [&](const dvec3& position) {
        for (int k = 0; k < 3; ++k) lamp.position[k] = origin_[k] + position[k];
        stage_.check(api_.add_light(stage_.scene(), &lamp, &light), "adding a lamp");
    };
    lamp.radius = 30;
    for (float& part : lamp.intensity) part = 160;
    place_lamp({-0.5, 4, -9});
    for (float& part : lamp.intensity) part = 30;
    lamp.source_radius = 0.1f;
    place_lamp({0.6, 5, -0.4});
}

void GlassScene::change_sky() {
    constexpr int kWidth = 64, kHeight = 32;
    std::vector<float> texels;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float up = 1 - float(y) / kHeight;
            const bool cloud = (x / 3 * 5 + y / 2 * 3) % 7 < 2 && y < kHeight / 2;
            const bool sun = x > 36 && x < 40 && y > 6 && y < 10;
            const vec3 color = sun     ? vec3(9, 7, 4)
                               : cloud ? vec3(0.9f)
                                       : vec3(0.8f, 0.6f, 0.4f) * (1 - up) + vec3(0.1f, 0.2f, 0.5f);
            texels.insert(texels.end(), {color.x, color.y, color.z, 1});
        }
    rt_texture_desc desc = rt_default_texture_desc();
    desc.format = RT_FORMAT_RGBA32F;
    desc.width = kWidth;
    desc.height = kHeight;
    desc.pixels = texels.data();
    rt_environment environment = rt_default_environment();
    environment.sky = RT_SKY_TEXTURE;
    environment.sky_intensity = 0.8f;
    environment.sky_rotation = 0.4f;
    stage_.check(api_.add_texture(stage_.scene(), &desc, &environment.sky_texture),
                 "adding a texture");
    stage_.check(api_.set_environment(stage_.scene(), &environment), "setting the environment");
}

// Rows of axes are those of the map.
void GlassScene::place(const glm::dmat3& axes, const dvec3& position) {
    rt_transform transform = rt_default_transform();
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) transform.m[4 * row + k] = axes[row][k];
        transform.m[4 * row + 3] = origin_[row] + position[row];
    }
    stage_.check(api_.set_mesh_transform(stage_.scene(), box_, &transform), "placing a mesh");
}

void GlassScene::add_lights() {
    rt_light_desc desc = rt_default_light_desc();
    const dvec3 position = origin_ + dvec3(1.2, 2.8, -0.5);
    for (int k = 0; k < 3; ++k) desc.position[k] = position[k];
    copy({9, 8, 7}, desc.intensity);
    rt_light light;
    stage_.check(api_.add_light(stage_.scene(), &desc, &light), "adding a light");
    rt_light_desc sun = rt_default_light_desc();
    sun.type = RT_LIGHT_DIRECTIONAL;
    copy({0.3f, -0.8f, 0.7f}, sun.direction);
    copy({1.6f, 1.5f, 1.3f}, sun.intensity);
    stage_.check(api_.add_light(stage_.scene(), &sun, &light), "adding a light");
}

rt_camera GlassScene::look(const dvec3& position, const vec3& forward) const {
    rt_camera camera = rt_default_camera();
    for (int k = 0; k < 3; ++k) camera.position[k] = origin_[k] + position[k];
    copy(forward, camera.forward);
    camera.vertical_fov = 0.9f;
    return camera;
}

rt_camera GlassScene::camera() const {
    return look({0.3, 1.6, 2.4}, {-0.05f, -0.2f, -1});
}

rt_camera GlassScene::camera_at_the_sky() const {
    rt_camera camera = look({0.3, 2.6, 2.4}, {0.1f, 0.4f, -1});
    camera.vertical_fov = 1.8f;
    return camera;
}

rt_camera GlassScene::camera_in_the_die() const {
    return look({-1.2, 0.5, -0.8}, {0.4f, 0.05f, -0.7f});
}

} // namespace peregrine::test
