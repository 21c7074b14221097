// Mirrors against the formulas, in doubles.
#include "path_scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

//     eye
//      \  /
//   ----\/---- mirror     the ruler is above the eye
TEST(Mirror, ShowsWhatIsThereByTheLawOfReflection) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 50, 0, world.add(mirror(1)));
        add_ruler(world, 40, 2);
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        EXPECT_NEAR(read_ruler(seen, 40), 3 * std::tan(angle * kDegree), 0.02) << angle;
        EXPECT_NEAR(seen.y, 1, 1e-6) << angle;
    }
}

TEST(Mirror, ReflectsMoreAtAGlance) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 50, 0, world.add(mirror(0.5f, {1, 0.5f, 0})));
        add_floor(world, 50, 2, world.add(glowing(Vec3(3))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        const double more = std::pow(1 - std::cos(angle * kDegree), 5);
        for (int k = 0; k < 3; ++k) {
            const double head_on = 0.5 * (1 - 0.5 * k);
            EXPECT_NEAR(seen[k], 3 * (head_on + (1 - head_on) * more), 1e-5) << angle;
        }
    }
}

TEST(Mirror, LeavesTheRestToTheSurface) {
    RenderScene world;
    world.scene.environment.ambient = Vec3(0.5f);
    scene::Material material = mirror(0.25f);
    material.base_color = {0.8f, 0.4f, 0, 1};
    add_floor(world, 50, 0, world.add(material));
    const Vec3 seen = see(world, looking({0, 1, 0}, 0), 1);
    EXPECT_NEAR(seen.x, 0.75 * 0.8 * 0.5, 1e-6);
    EXPECT_NEAR(seen.y, 0.75 * 0.4 * 0.5, 1e-6);
    EXPECT_EQ(see(world, looking({0, 1, 0}, 0), 0), Vec3(0.4f, 0.2f, 0)) << "matt without bounces";
}

// Each sends back nine tenths and glows itself.
TEST(Mirror, TwoThatFaceEachOtherEndAtTheGreatestDepth) {
    RenderScene world;
    scene::Material material = mirror(0.9f);
    material.emissive = Vec3(0.01f);
    const base::Handle handle = world.add(material);
    add_floor(world, 50, 0, handle);
    add_floor(world, 50, 2, handle);
    world.scene.environment.ambient = Vec3(0.3f);
    for (const uint32_t depth : {1u, 2u, 4u, 16u}) {
        const Picture picture = take_picture(world, looking({0, 1, 0}, 0), frame_of(5, depth));
        double expected = 0.3 * std::pow(0.9, depth + 1); // what is not traced
        for (uint32_t i = 0; i <= depth; ++i) expected += 0.01 * std::pow(0.9, i);
        EXPECT_NEAR(picture.at(2, 2).x, expected, 1e-5) << depth;
        EXPECT_EQ(picture.stats.rays_bounced, 25u * depth);
    }
}

TEST(Mirror, PathsThatHardlyCountEnd) {
    RenderScene world;
    add_floor(world, 50, 0, world.add(mirror(0.1f)));
    add_floor(world, 50, 2, world.add(glowing(Vec3(1))));
    Frame frame = frame_of(5, 4);
    frame.bounces.least_importance = 0.09f;
    EXPECT_EQ(take_picture(world, looking({0, 1, 0}, 0), frame).stats.rays_bounced, 25u);
    frame.exposure = 0.5f; // it shows half as much
    const Picture picture = take_picture(world, looking({0, 1, 0}, 0), frame);
    EXPECT_EQ(picture.stats.rays_bounced, 0u);
    EXPECT_EQ(picture.at(2, 2), Vec3(0));
}

// Bumps and smooth normals may not send light into the surface.
TEST(Mirror, ANormalMapNeverLooksThroughTheMirror) {
    RenderScene world;
    const base::Handle map = world.add_texture(1, 1, {0.98f, 0.5f, 0.55f, 1});
    add_floor(world, 50, 0, world.add(mirror(1), {}, map));
    add_floor(world, 500, -1, world.add(glowing(Vec3(1)))); // beneath
    for (const double angle : {-80.0, -45.0, 0.0, 45.0, 80.0})
        EXPECT_EQ(see(world, looking({0, 1, 0}, angle * kDegree), 2), Vec3(0)) << angle;
}

} // namespace
} // namespace peregrine::test
