#include <cmath>

#include <gtest/gtest.h>

#include "emissive_lamps.h"
#include "gltf/import.h"
#include "gltf_builder.h"
#include "plugin.h"
#include "upload.h"

// Lamps of glTF files through the engine itself: what they give, in lux.
namespace host::test {
namespace {

// A plate of 2 m in the plane y = 1, facing up, seen from above.
class LampsOnEngine : public testing::Test {
protected:
    LampsOnEngine() : plugin(ENGINE), stage(plugin.api(), 1, RT_ISA_BEST) {
        const int positions = builder.add_positions({-1, 1, 1, 1, 1, 1, 1, 1, -1, -1, 1, -1});
        const int indices =
            builder.add_accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
        builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        builder.json["materials"] = Json::array();
    }

    // Of the plate's middle.
    double lux(const Json& light, const Json& place) {
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
        const Json shown = {{"KHR_lights_punctual", {{"light", 0}}}};
        const int lamp = builder.push("nodes", {{"extensions", shown}, {"translation", place}});
        builder.json["scenes"][0]["nodes"] = {0, lamp};
        return lux(gltf::import_bytes(builder.glb(), "test", ""));
    }

    double lux(const Level& level) {
        upload_level(stage, level, 0.0f);
        stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
        Viewpoint eye;
        eye.position = {0, 3, 0};
        eye.forward = {0, -1, 0};
        eye.up = {0, 0, -1};
        eye.vertical_fov = 0.01f;
        Frame frame;
        frame.width = frame.height = 1;
        frame.format = RT_FORMAT_RGBA32F;
        frame.tone_mapping = RT_TONE_NONE;
        float pixel[4] = {};
        stage.render(eye, frame, pixel);
        return static_cast<double>(pixel[0]) / albedo(level) * 3.14159265358979;
    }

    static double albedo(const Level& level) {
        return level.materials.empty() ? 1.0 : static_cast<double>(level.materials[0].base_color.r);
    }

    Plugin plugin;
    Stage stage;
    GltfBuilder builder;
};

// A box that glows, over the plate: what it is made of does not shadow its lamps.
TEST_F(LampsOnEngine, WhatGlowsDoesNotShadowItsLamps) {
    Level level = gltf::import_bytes(builder.glb(), "test", "");
    const auto glow = static_cast<uint32_t>(level.materials.size());
    level.materials.emplace_back().emissive = glm::vec3(80.0f);
    Mesh& box = level.meshes.emplace_back();
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.05f, 0.05f}) {
            glm::vec3 w(0), u(0), v(0);
            w[axis] = side;
            u[(axis + 1) % 3] = 0.05f;
            v[(axis + 2) % 3] = side;
            for (const glm::vec3& corner : {-u - v, u - v, u + v, -u - v, u + v, v - u}) {
                box.indices.push_back(static_cast<uint32_t>(box.positions.size()));
                box.positions.push_back(glm::vec3(0.6f, 2.2f, 0.3f) + w + corner);
            }
            box.materials.insert(box.materials.end(), 2, glow);
        }
    level.lights = find_emissive_lamps(level, 16).lights;
    ASSERT_EQ(level.lights.size(), 6u);
    double expected = 0;
    for (const Light& light : level.lights) {
        const glm::dvec3 way = glm::dvec3(0, 1, 0) - light.position;
        const double distance = glm::length(way);
        const double s = std::max(glm::dot(glm::dvec3(light.direction), way) / distance, 0.0);
        expected += static_cast<double>(light.intensity.x) * s * s * (3 - 2 * s) * -way.y
                    / (distance * distance * distance);
    }
    EXPECT_NEAR(lux(level), expected, 2e-3 * expected);
}

TEST_F(LampsOnEngine, WithoutARangeTheyHaveNoEnd) {
    const double square = 4.08 * 4.08 + 4.9 * 4.9 + 1.01 * 1.01;
    const double expected = 54.35 / square * 4.9 / std::sqrt(square);
    EXPECT_NEAR(lux({{"type", "point"}, {"intensity", 54.35}}, {4.08, 5.90, -1.01}), expected,
                1e-3 * expected);
}

TEST_F(LampsOnEngine, AlsoFarAboveASmallScene) {
    EXPECT_NEAR(lux({{"type", "point"}, {"intensity", 5e6}}, {0, 1001, 0}), 5.0, 5e-3);
}

TEST_F(LampsOnEngine, ARangeIsTheWindowOfTheExtension) {
    const Json lamp = {{"type", "point"}, {"intensity", 8}, {"range", 4}};
    EXPECT_NEAR(lux(lamp, {0, 3, 0}), 8.0 / 4 * (1 - 1.0 / 16), 1e-3);
}

} // namespace
} // namespace host::test
