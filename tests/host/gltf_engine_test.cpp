#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/player.h"
#include "cameras.h"
#include "gltf/import.h"
#include "plugin.h"
#include "probe.h"
#include "walker.h"

// Scene files through the engine itself: far from the origin, and instanced.
namespace host::test {
namespace {

const glm::dvec3 far_away(4000000.25, 300.125, -2700000.5);

// A scene in an engine of its own.
struct World {
    World(const GltfBuilder& builder, const glm::dvec3& place)
        : place(place), plugin(ENGINE), stage(plugin.api(), 1, RT_ISA_BEST), probe(stage),
          level(import(builder, place)), player(stage, level, upload_level(stage, level, 0.3f)) {
        player.describe(0.0);
        stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
    }

    static Level import(GltfBuilder builder, const glm::dvec3& place) {
        const int root = builder.push("nodes", {{"translation", {place.x, place.y, place.z}},
                                                {"children", builder.json["scenes"][0]["nodes"]}});
        builder.json["scenes"][0]["nodes"] = {root};
        return gltf::import_bytes(builder.glb(), "test", "");
    }

    // Along -Z, relative to the scene's place; a negative number is a miss.
    double from_front(double x, double y) const {
        const auto contact = probe.cast(place + glm::dvec3(x, y, 5), {0, 0, -1}, 100);
        return contact ? contact->distance : -1.0;
    }

    std::vector<uint8_t> picture() const {
        Frame frame;
        frame.width = 64;
        frame.height = 48;
        std::vector<uint8_t> pixels(size_t{4} * frame.width * frame.height);
        stage.render(usable_cameras(level).front(), frame, pixels.data());
        return pixels;
    }

    glm::dvec3 place;
    Plugin plugin;
    Stage stage;
    Probe probe;
    Level level;
    Player player;
};

// A quad that leans by a slope of 0.3 in x and 0.1 in y.
GltfBuilder make_slope() {
    GltfBuilder builder = make_quad();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        builder.add_positions({-1, -1, -0.4f, 1, -1, 0.2f, 1, 1, 0.4f, -1, 1, -0.2f});
    return builder;
}

TEST(GltfOnEngine, AFarSceneIsNotDeformed) {
    const World near(make_slope(), glm::dvec3(0.0)), far(make_slope(), far_away);
    for (double x = -0.99; x < 1.0; x += 0.09)
        for (double y = -0.98; y < 1.0; y += 0.11) {
            EXPECT_NEAR(near.from_front(x, y), 5.0 - 0.3 * x - 0.1 * y, 2e-6);
            EXPECT_NEAR(far.from_front(x, y), 5.0 - 0.3 * x - 0.1 * y, 2e-6);
        }
    EXPECT_LT(far.from_front(1.001, 0), 0.0);
    EXPECT_LT(far.from_front(0, -1.001), 0.0);
}

TEST(GltfOnEngine, AFarSceneLooksAsANearOne) {
    const auto near = World(make_slope(), glm::dvec3(0.0)).picture();
    const auto far = World(make_slope(), far_away).picture();
    size_t different = 0;
    for (size_t i = 0; i < near.size(); ++i) different += std::abs(near[i] - far[i]) > 2 ? 1 : 0;
    EXPECT_LT(different, near.size() / 200); // pixels on an edge
}

TEST(GltfOnEngine, AFarSkinBends) {
    World far(make_strip(), far_away);
    EXPECT_NEAR(far.from_front(1.5, 10.5), 5.0, 2e-6);
    far.player.show(1.0, RT_STRUCTURE_AUTO, RT_BUILD_BALANCED);
    EXPECT_NEAR(far.from_front(1.0, 11.3), 5.0, 2e-6);
    EXPECT_LT(far.from_front(1.9, 10.5), 0.0);
}

TEST(GltfOnEngine, AWalkerStandsOnAFarFloor) {
    GltfBuilder builder = make_quad();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        builder.add_positions({-20, 0, 20, 20, 0, 20, 20, 0, -20, -20, 0, -20});
    const World far(builder, far_away);
    Walker walker(far.probe);
    Viewpoint start;
    start.position = far_away + glm::dvec3(0, 3, 0);
    walker.place(start);
    walker.toggle_walking();
    Controls controls;
    controls.forward = 1.0f;
    for (int i = 0; i < 100; ++i) walker.step(controls, 0.02);
    EXPECT_NEAR(walker.viewpoint().position.y - far_away.y, 1.65, 1e-3);
    EXPECT_NEAR(walker.viewpoint().position.z - far_away.z, -7.0, 1e-3);
}

TEST(GltfOnEngine, InstancesStandWhereTheFileSays) {
    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.add_positions({0, 0, 0, 3, 0, -1, 6, 0, -2, 9, 0, -3})},
        {"SCALE", builder.add_positions({1, 1, 1, -1, 1, 1, 2, 2, 2, 0, 0, 0})}};
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(64, 8, -16)}) {
        const World world(builder, place);
        EXPECT_NEAR(world.from_front(0.5, 0.5), 5.0, 1e-5);
        EXPECT_NEAR(world.from_front(2.5, 0.5), 6.0, 1e-5); // mirrored: from 3 to 2
        EXPECT_LT(world.from_front(3.5, 0.5), 0.0);
        EXPECT_NEAR(world.from_front(7.5, 1.5), 7.0, 1e-5);
        EXPECT_LT(world.from_front(9.0, 0.0), 0.0); // scaled to nothing
        EXPECT_LT(world.from_front(1.5, 0.5), 0.0);
    }
}

} // namespace
} // namespace host::test
