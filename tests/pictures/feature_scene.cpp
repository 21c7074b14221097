#include "feature_scene.h"

#include "shapes.h"

#include <iterator>

namespace peregrine::test {
namespace {

using glm::dvec3;
using glm::vec3;
using glm::vec4;

void copy(const vec3& from, float* to) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

rt_material_desc matt(const vec3& color) {
    rt_material_desc desc = rt_default_material_desc();
    copy(color, desc.base_color);
    desc.double_sided = 1;
    return desc;
}

rt_texture_desc texture_of(rt_pixel_format format, uint32_t width, uint32_t height,
                           rt_filter filter = RT_FILTER_BILINEAR) {
    rt_texture_desc desc = rt_default_texture_desc();
    desc.format = format;
    desc.width = width;
    desc.height = height;
    desc.filter = filter;
    return desc;
}

// No two texels alike, and no side like another.
vec4 tile_color(int x, int y) {
    return vec4(float(x * 50 + 20), float(y * 80 + 40), float((x * 3 + y * 5) % 4 * 60), 255)
           / 255.0f;
}

} // namespace

FeatureScene::FeatureScene(host::Stage& stage, const dvec3& origin)
    : stage_(stage), api_(stage.api()), origin_(origin) {
    stage_.check(api_.set_world_origin(stage_.scene(), &origin_.x), "setting the origin");
    add_textures();
    add_floor();
    add_panels();
    add_fence();
    add_ball();
    add_boxes();
    add_flag();
    add_glow();
    add_single_sided();
    add_lights();
    rt_environment environment = rt_default_environment();
    copy({0.06f, 0.07f, 0.09f}, environment.ambient);
    copy({0.2f, 0.3f, 0.45f}, environment.background);
    stage_.check(api_.set_environment(stage_.scene(), &environment), "setting the environment");
}

template <class ColorOf>
rt_texture FeatureScene::add_texture(rt_texture_desc desc, const ColorOf& color_of) {
    std::vector<uint8_t> bytes;
    std::vector<vec4> floats;
    for (int y = 0; y < int(desc.height); ++y)
        for (int x = 0; x < int(desc.width); ++x) {
            vec4 color = color_of(x, y);
            floats.push_back(color);
            if (desc.format == RT_FORMAT_BGRA8_SRGB) std::swap(color.x, color.z);
            for (int k = 0; k < 4; ++k) bytes.push_back(uint8_t(color[k] * 255.0f + 0.5f));
        }
    desc.pixels =
        desc.format == RT_FORMAT_RGBA32F ? static_cast<const void*>(floats.data()) : bytes.data();
    rt_texture texture;
    stage_.check(api_.add_texture(stage_.scene(), &desc, &texture), "adding a texture");
    return texture;
}

rt_material FeatureScene::add_material(const rt_material_desc& desc) {
    rt_material material;
    stage_.check(api_.add_material(stage_.scene(), &desc, &material), "adding a material");
    return material;
}

void FeatureScene::add_textures() {
    tiles_ = add_texture(texture_of(RT_FORMAT_RGBA8_SRGB, 5, 3), tile_color);
    bumps_ = add_texture(texture_of(RT_FORMAT_RGBA8_LINEAR, 8, 8), [](int x, int y) {
        const vec3 normal(0.12f * float(x % 4 - 2), 0.15f * float(y % 3 - 1), 0.9f);
        return vec4(0.5f * normal + 0.5f, 1);
    });
    mask_ = add_texture(texture_of(RT_FORMAT_RGBA8_SRGB, 16, 16), [](int x, int y) {
        const bool wire = x % 4 == 0 || y % 4 == 0;
        return vec4(0.8f, 0.6f, 0.2f, wire ? 1.0f : 0.1f * float((x + y) % 4));
    });
    glow_ =
        add_texture(texture_of(RT_FORMAT_RGBA8_SRGB, 4, 4, RT_FILTER_NEAREST), [](int x, int y) {
            return (x + y) % 2 ? vec4(1, 0.5f, 0.1f, 1) : vec4(0.1f, 0.2f, 0.6f, 1);
        });
}

// Glossy, with a normal map and a texture that a transform repeats.
void FeatureScene::add_floor() {
    floor_desc_ = matt({0.8f, 0.8f, 0.8f});
    copy(vec3(0.25f), floor_desc_.specular);
    floor_desc_.shininess = 24;
    floor_desc_.base_color_texture.texture = tiles_;
    floor_desc_.base_color_texture.transform[0] = 6;
    floor_desc_.base_color_texture.transform[1] = 0.5f;
    floor_desc_.base_color_texture.transform[4] = 8;
    floor_desc_.normal_texture.texture = bumps_;
    floor_desc_.normal_texture.transform[0] = floor_desc_.normal_texture.transform[4] = 5;
    floor_ = add_material(floor_desc_);
    const Shape floor = make_grid({-6, 0, 4}, {12, 0, 0}, {0, 0, -12}, 3);
    rt_mesh_desc desc = floor.desc();
    desc.material = floor_;
    rt_mesh mesh;
    stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding the floor");
}

// Every wrap with every filter, and the other formats, over more than a texture's width.
void FeatureScene::add_panels() {
    constexpr rt_wrap kWraps[] = {RT_WRAP_REPEAT, RT_WRAP_MIRROR, RT_WRAP_CLAMP};
    rt_texture textures[8];
    for (int i = 0; i < 8; ++i) {
        const rt_pixel_format format = i == 6   ? RT_FORMAT_BGRA8_SRGB
                                       : i == 7 ? RT_FORMAT_RGBA32F
                                                : RT_FORMAT_RGBA8_SRGB;
        rt_texture_desc desc =
            texture_of(format, 5, 3, i / 3 % 2 ? RT_FILTER_NEAREST : RT_FILTER_BILINEAR);
        desc.wrap_u = kWraps[i % 3];
        desc.wrap_v = kWraps[(i + i / 3) % 3];
        textures[i] = add_texture(desc, tile_color);
    }
    for (int i = 0; i < 8; ++i) {
        rt_material_desc material = matt(vec3(0.9f));
        material.base_color_texture.texture = textures[i];
        Shape panel = make_grid({-5.6f + 2.8f * float(i % 4), 0.4f + 2.3f * float(i / 4), -8},
                                {2.5f, 0, 0}, {0, 2, 0}, 1);
        for (glm::vec2& texcoord : panel.texcoords) texcoord = texcoord * 2.5f - 0.75f;
        panel.normals.assign(panel.positions.size(), {0, 0, 1});
        rt_mesh_desc desc = panel.desc();
        desc.material = add_material(material);
        rt_mesh mesh;
        stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding a panel");
    }
}

// Masked, double-sided, with indices of 16 bits.
void FeatureScene::add_fence() {
    rt_material_desc material = matt({1, 1, 1});
    material.alpha_mode = RT_ALPHA_MASK;
    material.alpha_cutoff = 0.25f;
    material.base_color_texture.texture = mask_;
    const Shape fence = make_grid({-4.5f, 0, -2.6f}, {2.4f, 0, 0.5f}, {0, 1.6f, -0.2f}, 2);
    const std::vector<uint16_t> indices(fence.indices.begin(), fence.indices.end());
    rt_mesh_desc desc = fence.desc();
    desc.index_type = RT_INDEX_UINT16;
    desc.indices.data = indices.data();
    desc.material = add_material(material);
    rt_mesh mesh;
    stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding the fence");
}

// Smooth; its triangles take turns between a glossy material and a matt one.
void FeatureScene::add_ball() {
    rt_material_desc glossy = matt({0.1f, 0.3f, 0.15f});
    copy({0.6f, 0.5f, 0.4f}, glossy.specular);
    glossy.shininess = 60;
    const rt_material both[] = {add_material(glossy), add_material(matt({0.7f, 0.1f, 0.1f}))};
    const Shape ball = make_ball({-0.9f, 0.9f, -3.8f}, 0.9f, 8);
    std::vector<rt_material> materials;
    for (size_t i = 0; i < ball.indices.size() / 3; ++i) materials.push_back(both[i / 8 % 2]);
    rt_mesh_desc desc = ball.desc();
    desc.materials = {materials.data(), materials.size(), 0, 0};
    rt_mesh mesh;
    stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding the ball");
}

// Two places of one shape; the twin is mirrored and sheared.
void FeatureScene::add_boxes() {
    rt_material_desc material = matt({1, 1, 1});
    material.double_sided = 0;
    material.base_color_texture.texture = tiles_;
    material.normal_texture.texture = bumps_;
    material.normal_scale = 0.6f;
    const Shape box = make_box();
    rt_mesh_desc desc = box.desc();
    desc.material = add_material(material);
    stage_.check(api_.add_rigid_mesh(stage_.scene(), &desc, &box_), "adding the box");
    stage_.check(api_.add_mesh_instance(stage_.scene(), box_, &twin_), "adding its twin");
    place(box_, {0.4, 0, -0.3, 0, 0.5, 0, 0.3, 0, 0.4}, {1.2, 0.5, -2.4});
    place(twin_, {-0.5, 0, 0.1, 0.2, 0.7, 0, 0, 0, 0.5}, {3.4, 0.7, -4.2});
}

void FeatureScene::add_flag() {
    rt_material_desc material = matt({0.9f, 0.9f, 0.9f});
    material.base_color_texture.texture = tiles_;
    const Shape flag = make_flag({-4.4f, 3.4f, -5}, 0);
    rt_mesh_desc desc = flag.desc();
    desc.material = add_material(material);
    stage_.check(api_.add_dynamic_mesh(stage_.scene(), &desc, &flag_), "adding the flag");
}

// Its light comes by the second set of texture coordinates, its colour by the first; the tangents
// are given, and turn the other way round.
void FeatureScene::add_glow() {
    rt_material_desc material = matt({0.3f, 0.3f, 0.3f});
    copy({1.5f, 1.5f, 1.5f}, material.emissive);
    material.base_color_texture.texture = tiles_;
    material.emissive_texture.texture = glow_;
    material.emissive_texture.texcoord_set = 1;
    material.normal_texture.texture = bumps_;
    Shape glow = make_grid({0.6f, 1.4f, -6}, {1.6f, 0, 0.4f}, {0, 1.4f, 0}, 1);
    for (const glm::vec2& texcoord : glow.texcoords)
        glow.texcoords1.emplace_back(texcoord.y * 1.5f, texcoord.x * 2);
    glow.tangents.assign(glow.positions.size(), {0, 1, 0, -1});
    rt_mesh_desc desc = glow.desc();
    desc.material = add_material(material);
    rt_mesh mesh;
    stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &mesh), "adding what glows");
}

// One shows its front; through the back of the other one the camera sees, and light does not.
// Without indices.
void FeatureScene::add_single_sided() {
    rt_material_desc material = matt({0.2f, 0.5f, 0.8f});
    material.double_sided = 0;
    const rt_material handle = add_material(material);
    for (int i = 0; i < 2; ++i) {
        const float x = i ? 2.4f : -2.0f;
        const vec3 a(x, 0.1f, -0.2f), b(x + 0.9f, 0.1f, -0.4f), c(x + 0.4f, 1.2f, -0.3f);
        const std::vector<vec3> corners =
            i ? std::vector<vec3>{a, c, b} : std::vector<vec3>{a, b, c};
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.index_type = RT_INDEX_NONE;
        desc.positions = {corners.data(), corners.size(), 0, 0};
        desc.material = handle;
        stage_.check(api_.add_static_mesh(stage_.scene(), &desc, &seen_), "adding a triangle");
    }
}

void FeatureScene::add_light(rt_light_desc desc, const dvec3& position, bool shadows,
                             rt_light* out) {
    for (int k = 0; k < 3; ++k) desc.position[k] = origin_[k] + position[k];
    desc.casts_no_shadow = shadows ? 0 : 1;
    rt_light light;
    stage_.check(api_.add_light(stage_.scene(), &desc, &light), "adding a light");
    if (out) *out = light;
    lights_.emplace_back(light, desc);
}

void FeatureScene::soften() {
    for (auto& [light, desc] : lights_) {
        desc.source_radius = desc.type == RT_LIGHT_DIRECTIONAL ? 0.03f : 0.15f;
        desc.shadow_samples = desc.type == RT_LIGHT_SPOT ? 7 : 0;
        stage_.check(api_.update_light(stage_.scene(), light, &desc), "softening a light");
    }
}

// Each kind with shadows and without.
void FeatureScene::add_lights() {
    rt_light_desc point = rt_default_light_desc();
    point.radius = 12;
    copy({16, 14, 11}, point.intensity);
    add_light(point, {0.6, 4.2, -1}, true, &lamp_);
    lamp_desc_ = point;
    point.radius = 6;
    copy({2, 4, 3}, point.intensity);
    add_light(point, {-4.5, 1.2, -0.5}, false);

    rt_light_desc spot = rt_default_light_desc();
    spot.type = RT_LIGHT_SPOT;
    spot.radius = 15;
    copy({-0.4f, -1, -0.7f}, spot.direction);
    copy({30, 10, 40}, spot.intensity);
    spot.cone_inner_cos = 0.96f;
    spot.cone_outer_cos = 0.88f;
    add_light(spot, {3.5, 5, 0.5}, true);
    copy({0.1f, -0.3f, -1}, spot.direction);
    copy({3, 9, 4}, spot.intensity);
    add_light(spot, {-3.5, 3, -4}, false);

    rt_light_desc sun = rt_default_light_desc();
    sun.type = RT_LIGHT_DIRECTIONAL;
    copy({0.5f, -1, -0.8f}, sun.direction);
    copy({0.8f, 0.75f, 0.6f}, sun.intensity);
    add_light(sun, {}, true);
    copy({-1, -0.3f, -0.2f}, sun.direction);
    copy({0.05f, 0.08f, 0.15f}, sun.intensity);
    add_light(sun, {}, false);
}

// Rows of axes are those of the map.
void FeatureScene::place(rt_mesh mesh, const glm::dmat3& axes, const dvec3& position) {
    rt_transform transform = rt_default_transform();
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) transform.m[4 * row + k] = axes[row][k];
        transform.m[4 * row + 3] = origin_[row] + position[row];
    }
    stage_.check(api_.set_mesh_transform(stage_.scene(), mesh, &transform), "placing a mesh");
}

void FeatureScene::move() {
    const Shape flag = make_flag({-4.4f, 3.4f, -5}, 0.8f);
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = flag.desc().positions;
    stage_.check(api_.update_dynamic_mesh(stage_.scene(), flag_, &update), "waving the flag");
    place(box_, {0.3, 0.4, 0, -0.4, 0.3, 0, 0, 0, 0.5}, {1.6, 0.9, -2});
    place(twin_, {0.5, 0, 0, 0, 0.7, 0, 0, 0, -0.5}, {3.2, 0.8, -3.4});
    stage_.check(api_.set_mesh_hidden(stage_.scene(), seen_, 1), "hiding a mesh");
    rt_light_desc lamp = lamp_desc_;
    const dvec3 position = origin_ + dvec3(-2.5, 3.5, -2);
    for (int k = 0; k < 3; ++k) lamp.position[k] = position[k];
    stage_.check(api_.update_light(stage_.scene(), lamp_, &lamp), "moving a light");
    rt_material_desc floor = floor_desc_;
    copy({0.9f, 0.6f, 0.5f}, floor.base_color);
    stage_.check(api_.update_material(stage_.scene(), floor_, &floor), "changing a material");
}

rt_camera FeatureScene::look(const dvec3& position, const vec3& forward) const {
    rt_camera camera = rt_default_camera();
    for (int k = 0; k < 3; ++k) camera.position[k] = origin_[k] + position[k];
    copy(forward, camera.forward);
    return camera;
}

rt_camera FeatureScene::camera() const {
    rt_camera camera = look({0.1, 3, 4.4}, {0, -0.16f, -1});
    camera.vertical_fov = 0.65f;
    return camera;
}

rt_camera FeatureScene::camera_from_the_side() const {
    return look({5.5, 3, -7}, {-1, -0.35f, 0.55f});
}

} // namespace peregrine::test
