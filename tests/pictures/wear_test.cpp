// Textures of occlusion, roughness and metalness, bit for bit.
#include "shapes.h"
#include "variants.h"

namespace peregrine::test {
namespace {

using glm::vec3;

// Numbers of squares, which no two of them share.
constexpr int kSquares = 8;
constexpr uint32_t kTexels = 32;

class WearScene {
public:
    explicit WearScene(host::Stage& stage) : stage_(stage) {
        rt_texture_desc packed = describe(RT_FILTER_BILINEAR), other = describe(RT_FILTER_NEAREST);
        packed_ = add(packed, 1);
        other_ = add(other, 3);
        add_floor();
        add_balls();
        add_wall();
        add_lights();
    }

    rt_camera camera() const {
        rt_camera camera = rt_default_camera();
        const float forward[3] = {0, -0.35f, -1};
        std::copy_n(forward, 3, camera.forward);
        camera.position[1] = 2.4;
        camera.position[2] = 4;
        camera.vertical_fov = 0.7f;
        return camera;
    }

private:
    static rt_texture_desc describe(rt_filter filter) {
        rt_texture_desc desc = rt_default_texture_desc();
        desc.format = RT_FORMAT_RGBA8_LINEAR;
        desc.width = desc.height = kTexels;
        desc.filter = filter;
        return desc;
    }
    // Rows get smoother, columns more metallic, and seams are hidden.
    rt_texture add(rt_texture_desc desc, int step) {
        std::vector<uint8_t> texels;
        for (uint32_t y = 0; y < kTexels; ++y)
            for (uint32_t x = 0; x < kTexels; ++x) {
                const int column = int(x) * kSquares / int(kTexels) * step % kSquares;
                const int row = int(y) * kSquares / int(kTexels);
                const bool seam = x % 4 == 0 || y % 4 == 0;
                for (const int c : {seam ? 60 : 255, 40 + row * 30, column * 36, 255})
                    texels.push_back(uint8_t(c));
            }
        desc.pixels = texels.data();
        rt_texture texture;
        stage_.check(stage_.api().add_texture(stage_.scene(), &desc, &texture), "a texture");
        return texture;
    }
    static rt_material_desc colored(const vec3& color) {
        rt_material_desc desc = rt_default_material_desc();
        for (int k = 0; k < 3; ++k) {
            desc.base_color[k] = color[k];
            desc.specular[k] = 0.04f;
        }
        return desc;
    }
    void add(const Shape& shape, const rt_material_desc& material) {
        rt_mesh_desc desc = shape.desc();
        rt_mesh mesh;
        stage_.check(stage_.api().add_material(stage_.scene(), &material, &desc.material),
                     "a material");
        stage_.check(stage_.api().add_static_mesh(stage_.scene(), &desc, &mesh), "a mesh");
    }
    // Both from one texture, at one place.
    void add_floor() {
        rt_material_desc floor = colored({0.9f, 0.7f, 0.4f});
        floor.occlusion_texture.texture = floor.roughness_texture.texture = packed_;
        for (rt_texture_use* const use : {&floor.occlusion_texture, &floor.roughness_texture})
            use->transform[0] = use->transform[4] = 1;
        add(make_grid({-4, 0, 2}, {8, 0, 0}, {0, 0, -7}, 2), floor);
    }
    // One by its texture alone, one that mirrors too, one without any.
    void add_balls() {
        rt_material_desc material = colored({0.8f, 0.3f, 0.2f});
        material.roughness_texture.texture = other_;
        material.roughness = 0.9f;
        add(make_ball({-1.8f, 0.8f, -1}, 0.8f, 8), material);
        material = colored({0.9f, 0.8f, 0.5f});
        material.roughness_texture.texture = packed_;
        material.metalness = 0.8f;
        material.reflectivity = 0.4f;
        add(make_ball({0, 0.8f, -1}, 0.8f, 8), material);
        material = colored({0.2f, 0.4f, 0.8f});
        material.shininess = 40;
        add(make_ball({1.8f, 0.8f, -1}, 0.8f, 8), material);
    }
    // Each texture at a place of its own, among a colour's.
    void add_wall() {
        rt_material_desc wall = colored({0.7f, 0.7f, 0.7f});
        wall.base_color_texture.texture = other_;
        wall.base_color_texture.transform[0] = 2;
        wall.occlusion_texture.texture = packed_;
        wall.occlusion_texture.transform[1] = 0.7f;
        wall.occlusion_strength = 0.8f;
        wall.roughness_texture.texture = other_;
        wall.roughness_texture.transform[3] = -0.4f;
        add(make_grid({-4, 0, -4}, {8, 0, 0}, {0, 4, 0}, 2), wall);
    }
    void add_lights() {
        for (const float x : {-1.5f, 2.0f}) {
            rt_light_desc light = rt_default_light_desc();
            light.position[0] = double(x);
            light.position[1] = 3;
            light.position[2] = 1;
            light.radius = 20;
            for (float& c : light.intensity) c = 8;
            rt_light handle;
            stage_.check(stage_.api().add_light(stage_.scene(), &light, &handle), "a light");
        }
        rt_environment environment = rt_default_environment();
        for (float& c : environment.ambient) c = 0.15f;
        stage_.check(stage_.api().set_environment(stage_.scene(), &environment), "ambient light");
    }

    host::Stage& stage_;
    rt_texture packed_{}, other_{};
};

class WearPictures : public Pictures {};

TEST_P(WearPictures, TexelByTexel) {
    const WearScene scene(*stage_);
    commit();
    rt_frame_desc frame = frame_of(320, 180);
    frame.texture_filter = RT_TEXTURE_MIPMAPS;
    expect("wear", scene.camera(), frame);
}

TEST_P(WearPictures, Approximated) {
    if (GetParam().proofs) GTEST_SKIP() << "which lamps are compared depends on what was proved";
    const WearScene scene(*stage_);
    commit();
    rt_frame_desc frame = frame_of(161, 91);
    frame.light_block = 8;
    frame.edge_samples = 4;
    frame.occlusion_range = 1;
    expect("wear_direct", scene.camera(), frame);
}

INSTANTIATE_TEST_SUITE_P(By, WearPictures, all_variants(),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace peregrine::test
