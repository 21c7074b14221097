#include <gtest/gtest.h>

#include "animated_gltf.h"
#include "animation/player.h"
#include "cameras.h"
#include "gltf/import.h"
#include "plugin.h"
#include "probe.h"

// Animations through the engine itself: a ray meets things where they are at a time.
namespace host::test {
namespace {

class PlayerOnEngine : public testing::Test {
protected:
    PlayerOnEngine() : plugin(ENGINE), stage(plugin.api(), 1, RT_ISA_BEST), probe(stage) {}

    void open(const GltfBuilder& builder) {
        level = gltf::import_bytes(builder.glb(), "test", "");
        player.emplace(stage, level, upload_level(stage, level, 0.1f));
        player->describe(0.0);
        stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
    }

    void show(double time) { player->show(time, RT_STRUCTURE_AUTO, RT_BUILD_BALANCED); }

    // Along -Z from z = 5; a negative number is a miss.
    double from_front(double x, double y) const {
        const auto contact = probe.cast({x, y, 5}, {0, 0, -1}, 100);
        return contact ? contact->distance : -1.0;
    }

    uint64_t versions() const { return stage.stats().snapshot_version; }

    Plugin plugin;
    Stage stage;
    Probe probe;
    Level level;
    std::optional<Player> player;
};

TEST_F(PlayerOnEngine, TheDoorOpens) {
    open(make_door());
    EXPECT_NEAR(from_front(10.9, 0.5), 5.0, 1e-5);
    show(1.0); // x runs to 10.707; the door is at 45 degrees
    EXPECT_LT(from_front(10.9, 0.5), 0.0);
    EXPECT_NEAR(from_front(10.5, 0.5), 5.5, 1e-5);
    show(1.999999);
    EXPECT_LT(from_front(10.5, 0.5), 0.0);
    const auto side = probe.cast({5, 0.5, -0.5}, {1, 0, 0}, 100);
    ASSERT_TRUE(side);
    EXPECT_NEAR(side->distance, 5.0, 1e-4);
    EXPECT_EQ(versions(), 3u); // one commit a moment
}

TEST_F(PlayerOnEngine, TheStripBends) {
    open(make_strip());
    EXPECT_NEAR(from_front(1.5, 10.5), 5.0, 1e-5);
    EXPECT_LT(from_front(0.5, 11.5), 0.0);
    show(1.0); // the far corner is at (1, 10) + sqrt(2) (0, 1)
    EXPECT_NEAR(from_front(1.0, 11.3), 5.0, 1e-5);
    EXPECT_LT(from_front(1.9, 10.5), 0.0);
    show(1.999999);
    EXPECT_LT(from_front(1.5, 10.5), 0.0);
    EXPECT_NEAR(from_front(0.7, 10.7), 5.0, 1e-5);
}

TEST_F(PlayerOnEngine, InstancesMoveEachByItself) {
    GltfBuilder builder = make_quad();
    builder.push("nodes", {{"mesh", 0}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    add_channel(builder, 0, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 4, 0}, 3);
    add_channel(builder, 1, "translation", "LINEAR", {0, 1}, {8, 0, 0, 8, 0, 4}, 3);
    open(builder);
    show(0.5);
    EXPECT_NEAR(from_front(0.5, 2.5), 5.0, 1e-5);
    EXPECT_NEAR(from_front(8.5, 0.5), 3.0, 1e-5);
    EXPECT_LT(from_front(0.5, 0.5), 0.0);
}

TEST_F(PlayerOnEngine, WhatIsScaledToNothingIsHiddenUntilItGrows) {
    GltfBuilder builder = make_quad();
    add_channel(builder, 0, "scale", "STEP", {0, 1, 2, 3}, {1, 1, 1, 0, 0, 0, 2, 2, 2, 1, 1, 1}, 3);
    open(builder);
    EXPECT_NEAR(from_front(0.5, 0.5), 5.0, 1e-5);
    show(1.5);
    EXPECT_LT(from_front(0.5, 0.5), 0.0);
    show(2.5);
    EXPECT_NEAR(from_front(1.5, 1.5), 5.0, 1e-5);
}

TEST_F(PlayerOnEngine, NothingIsCommittedWhileNothingMoves) {
    GltfBuilder builder = make_quad();
    add_channel(builder, 0, "translation", "STEP", {0, 1, 2}, {0, 0, 0, 0, 4, 0, 0, 0, 0}, 3);
    open(builder);
    show(0.1);
    show(0.9);
    EXPECT_EQ(versions(), 1u);
    show(1.1);
    EXPECT_EQ(versions(), 2u);
}

// A lamp on the door lights the floor below wherever the door carries it.
TEST_F(PlayerOnEngine, LightsAndCamerasFollow) {
    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["scale"] = {100, 100, 1};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"range", 3.0}, {"intensity", 50.0}}};
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    const int lamp =
        builder.push("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const int eye = builder.push("nodes", {{"camera", 0}});
    builder.json["scenes"][0]["nodes"] = {0, lamp, eye};
    add_channel(builder, lamp, "translation", "LINEAR", {0, 1}, {10, 10, 1, 50, 10, 1}, 3);
    add_channel(builder, eye, "translation", "LINEAR", {0, 1}, {10, 10, 2, 50, 10, 2}, 3);
    open(builder);
    const auto brightness = [&](const Viewpoint& view) {
        Frame frame;
        frame.width = frame.height = 1;
        uint8_t pixel[4] = {};
        stage.render(view, frame, pixel);
        return int{pixel[0]};
    };
    const Viewpoint at_rest = level.cameras.at(0);
    const int lit = brightness(player->follow(at_rest));
    show(0.5);
    EXPECT_NEAR(player->follow(at_rest).position.x, 30.0, 1e-5);
    Viewpoint left = player->follow(at_rest);
    left.position.x = 10.0;
    EXPECT_EQ(brightness(player->follow(at_rest)), lit);
    EXPECT_LT(brightness(left), lit / 2);
}

TEST_F(PlayerOnEngine, AFileWithoutAnimationIsLeftAlone) {
    open(make_quad());
    EXPECT_FALSE(player->animated());
    show(5.0);
    EXPECT_EQ(versions(), 1u);
    EXPECT_EQ(level.meshes.size(), 1u);
}

} // namespace
} // namespace host::test
