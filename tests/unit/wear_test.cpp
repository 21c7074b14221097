// Textures of occlusion, roughness and metalness.
#include "render_scene.h"
#include "scene/features.h"
#include "shade/material/highlight.h"
#include "shade/material/roughness.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using shade::gain_table;
using shade::GainTable;
using shade::highlight_gain;
using shade::kLeastRoughness;
using shade::kMetalLoss;
using shade::kMostShininess;
using shade::kRoughnessFade;
using shade::shininess_of;
using test::Picture;
using test::RenderScene;
using test::take_picture;

constexpr uint32_t kSide = 16; // pixels

struct Wear {
    float occlusion = 1, roughness = 1, metalness = 0;
};

// A wall before the eye, its left half of one kind and its right half of the other.
struct WornWall : RenderScene {
    explicit WornWall(float ambient) { scene.environment.ambient = Vec3(ambient); }

    base::Handle add_texture_of(const Wear& left, const Wear& right) {
        return add_texture(2, 1,
                           {left.occlusion, left.roughness, left.metalness, 1, //
                            right.occlusion, right.roughness, right.metalness, 1});
    }
    void add_wall(const scene::Material& material, base::Handle occlusion, base::Handle roughness) {
        scene::MaterialDescription description{material, {}, {}, {}};
        description.occlusion_texture = occlusion;
        description.roughness_texture = roughness;
        add_quad({-2, -2, -2}, {2, -2, -2}, {2, 2, -2}, {-2, 2, -2},
                 scene.materials.insert(description));
    }
    void add_lamp() {
        scene::Light light;
        light.type = scene::LightType::point;
        light.position = {0.3f, 0.4f, 0};
        light.intensity = Vec3(3);
        light.radius = 50;
        add(light);
    }
    uint32_t features() {
        scene.commit({});
        return scene::SnapshotStore::Pin(scene.snapshots).get()->features;
    }
};

scene::Material worn(const Vec3& color) {
    scene::Material material;
    material.base_color = {color, 1};
    material.occlusion_strength = material.roughness = material.metalness = 1;
    return material;
}

TEST(Wear, OcclusionTexturesDimAmbientLightAlone) {
    WornWall world(0.5f);
    scene::Material material = worn({0.8f, 0.4f, 0.2f});
    material.emissive = Vec3(2);
    material.occlusion_strength = 0.5f;
    world.add_wall(material, world.add_texture_of({0.25f}, {1}), {});
    const Picture picture = take_picture(world, Camera{}, kSide, kSide);
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            const float left = x < kSide / 2 ? 1 - 0.5f * 0.75f : 1;
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(picture.at(x, y)[k], 2 + material.base_color[k] * 0.5f * left, 1e-6);
        }
}

//   |         the wall is worn, and a floor hides part of what is before it
//   |______
TEST(Wear, OcclusionTexturesHideOfWhatRaysFind) {
    Picture pictures[2];
    for (const bool is_worn : {false, true}) {
        WornWall world(1);
        world.add_wall(worn(Vec3(1)),
                       is_worn ? world.add_texture_of({0.25f}, {0.5f}) : base::Handle(), {});
        world.add_quad({-2, -0.5f, 1}, {2, -0.5f, 1}, {2, -0.5f, -2}, {-2, -0.5f, -2},
                       world.add(worn(Vec3(1))));
        Frame frame = test::float_frame(kSide, kSide);
        frame.occlusion = {2, 64, 1, 0.13f, 0.3f, 0.1f};
        pictures[is_worn] = take_picture(world, Camera{}, frame);
    }
    for (uint32_t x = 0; x < kSide; ++x) {
        const float left = x < kSide / 2 ? 0.25f : 0.5f;
        EXPECT_EQ(pictures[1].at(x, kSide / 2).x, pictures[0].at(x, kSide / 2).x * left) << x;
        EXPECT_LT(pictures[0].at(x, kSide / 2).x, 1) << x;
    }
}

// Half of a metal's colour stays matt.
TEST(Wear, MetalsAreHalfAsMatt) {
    WornWall world(1);
    const scene::Material material = worn({1, 0.5f, 0.25f});
    world.add_wall(material, {}, world.add_texture_of({1, 0.5f, 1}, {1, 0.5f, 0.5f}));
    const Picture picture = take_picture(world, Camera{}, kSide, kSide);
    EXPECT_EQ(picture.at(2, 2), Vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(picture.at(kSide - 2, 2), Vec3(0.75f, 0.375f, 0.1875f));
}

// A texture that is the same everywhere shows what factors do.
TEST(Wear, TexturesShowWhatFactorsDo) {
    const Vec3 color(0.9f, 0.6f, 0.3f);
    for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f})
        for (const float metalness : {0.0f, 0.5f, 1.0f}) {
            WornWall textured(0.1f), plain(0.1f);
            scene::Material material = worn(color);
            material.specular = Vec3(0.04f);
            const Wear wear{1, roughness, metalness};
            textured.add_wall(material, {}, textured.add_texture_of(wear, wear));
            material.base_color = {color * (1 - kMetalLoss * metalness), 1};
            material.specular =
                (Vec3(0.04f) + (color - 0.04f) * metalness) * (1 - kRoughnessFade * roughness);
            material.shininess = shininess_of(roughness);
            plain.add_wall(material, {}, {});
            textured.add_lamp();
            plain.add_lamp();
            const Picture a = take_picture(textured, Camera{}, kSide, kSide);
            const Picture b = take_picture(plain, Camera{}, kSide, kSide);
            for (uint32_t i = 0; i < kSide * kSide; ++i)
                for (uint32_t k = 0; k < 3; ++k)
                    EXPECT_NEAR(a.pixels[4 * i + k], b.pixels[4 * i + k],
                                0.004f * b.pixels[4 * i + k])
                        << roughness << " " << metalness;
        }
}

// The highlight head on: with the lamp at the eye, S is 1 / 1, times what arrives.
TEST(Wear, HighlightsHaveKnownHeights) {
    WornWall world(0);
    scene::Material material = worn(Vec3(1));
    material.metalness = 1;
    world.add_wall(material, {}, world.add_texture_of({1, 0.5f, 1}, {1, 0.5f, 1}));
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = {0, 0, -1};
    light.intensity = Vec3(1);
    world.add(light);
    Camera camera;
    camera.vertical_fov = 1e-3f;
    const float seen = take_picture(world, camera, 1, 1).at(0, 0).x;
    const float matt = 0.5f / 3.14159265f;
    EXPECT_NEAR(seen, matt + 0.6f * highlight_gain(30), 0.003f * seen); // 2 / 0.5^4 - 2
}

TEST(Wear, GainsAreInterpolatedClosely) {
    float worst = 0;
    for (int i = 0; i <= 20000; ++i) {
        const float roughness = float(i) / 20000;
        const float at =
            std::clamp((roughness - kLeastRoughness) / (1 - kLeastRoughness), 0.0f, 1.0f)
            * GainTable::kCells;
        const auto cell = std::min(uint32_t(at), GainTable::kCells - 1);
        const float* const gain = gain_table().gain + cell;
        const float found = gain[0] + (gain[1] - gain[0]) * (at - float(cell));
        const float exact = highlight_gain(shininess_of(roughness));
        worst = std::max(worst, std::fabs(found / exact - 1));
    }
    EXPECT_LT(worst, 0.005f);
    EXPECT_NEAR(shininess_of(0.5f), 30, 1e-4);
    EXPECT_NEAR(shininess_of(0), kMostShininess, 0.01f);
    EXPECT_EQ(shininess_of(1), 1.0f);
    EXPECT_NEAR(shininess_of(kLeastRoughness), kMostShininess, 0.01f);
}

TEST(Wear, AreFeaturesOfTheirOwn) {
    constexpr uint32_t kBoth = scene::kOcclusionTextures | scene::kRoughnessTextures;
    for (const bool occluded : {false, true})
        for (const bool rough : {false, true}) {
            WornWall world(1);
            const base::Handle texture = world.add_texture_of({}, {});
            world.add_wall(worn(Vec3(1)), occluded ? texture : base::Handle(),
                           rough ? texture : base::Handle());
            EXPECT_EQ(world.features() & kBoth,
                      (occluded ? uint32_t(scene::kOcclusionTextures) : 0)
                          | (rough ? uint32_t(scene::kRoughnessTextures) : 0));
        }
}

} // namespace
} // namespace peregrine::render
