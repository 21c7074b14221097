// Glass against the formulas, in doubles.
#include "path_scene.h"

#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

// Of unpolarised light that comes at an angle.
double fresnel(double angle, double from, double to) {
    const double sine = from / to * std::sin(angle);
    if (sine >= 1) return 1;
    const double c = std::cos(angle), t = std::sqrt(1 - sine * sine);
    const double s = (from * c - to * t) / (from * c + to * t);
    const double p = (to * c - from * t) / (to * c + from * t);
    return (s * s + p * p) / 2;
}

//      eye
//        \         air
//   ------\-------
//          |       glass
//   _______|______ ruler
TEST(Glass, BendsLightBySnellsLaw) {
    for (const double angle : {0.0, 20.0, 60.0, 85.0})
        for (const double index : {1.0, 1.33, 1.5, 2.4}) {
            RenderScene world;
            add_box(world, {-30, -5, -30}, {30, 0, 30}, world.add(glass(float(index))));
            add_ruler(world, 26, -1);
            const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 2);
            const double bent = std::asin(std::sin(angle * kDegree) / index);
            EXPECT_NEAR(read_ruler(seen, 26), std::tan(angle * kDegree) + std::tan(bent), 0.01)
                << angle << " " << index;
            EXPECT_NEAR(seen.y, 1 - fresnel(angle * kDegree, 1, index), 1e-5)
                << angle << " " << index;
        }
}

TEST(Glass, MirrorsByFresnelsEquations) {
    for (const double angle : {0.0, 30.0, 56.3, 60.0, 85.0}) {
        RenderScene world;
        add_box(world, {-90, -5, -90}, {90, 0, 90}, world.add(glass()));
        add_floor(world, 90, 2, world.add(glowing(Vec3(1))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        EXPECT_NEAR(seen.x, fresnel(angle * kDegree, 1, 1.5), 1e-5) << angle;
    }
}

// From within, up: what is not bent out is all mirrored down.
TEST(Glass, ReflectsTotallyBeyondTheCriticalAngle) {
    for (const double angle : {0.0, 20.0, 41.0, 43.0, 60.0, 80.0}) {
        RenderScene world;
        add_box(world, {-90, -9, -90}, {90, 0, 90}, world.add(glass()));
        add_ruler(world, 80, 1);
        add_floor(world, 80, -2, world.add(glowing({0, 0, 1})));
        const Vec3 seen = see(world, looking({0, -1, 0}, (180 - angle) * kDegree), 1);
        const double back = fresnel(angle * kDegree, 1.5, 1);
        EXPECT_NEAR(seen.y, 1 - back, 1e-4) << angle;
        EXPECT_NEAR(seen.z, 1, 1e-5) << angle << ": both are as bright";
        if (back == 1) continue;
        const double out = std::asin(1.5 * std::sin(angle * kDegree));
        EXPECT_NEAR(read_ruler(seen, 80), std::tan(angle * kDegree) + std::tan(out), 0.03) << angle;
    }
}

TEST(Glass, SwallowsLightByBeersLaw) {
    for (const double angle : {0.0, 60.0}) {
        RenderScene world;
        scene::Material material = glass();
        // Half of the red, a quarter of the green, and none of the blue is lost in two metres.
        material.absorption = {float(std::log(2.0) / 2), float(std::log(4.0 / 3) / 2), 0};
        add_box(world, {-30, -3, -30}, {30, 0, 30}, world.add(material));
        add_floor(world, 30, -4, world.add(glowing(Vec3(1))));
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 2);
        const double bent = std::asin(std::sin(angle * kDegree) / 1.5);
        const double metres = 3 / std::cos(bent);
        const double through = std::pow(1 - fresnel(angle * kDegree, 1, 1.5), 2);
        EXPECT_NEAR(seen.x, through * std::pow(0.5, metres / 2), 1e-5);
        EXPECT_NEAR(seen.y, through * std::pow(0.75, metres / 2), 1e-5);
        EXPECT_NEAR(seen.z, through, 1e-5);
    }
}

TEST(Glass, SwallowsWhatTheEyeWithinSees) {
    RenderScene world;
    scene::Material material = glass();
    material.absorption = Vec3(float(std::log(2.0)));
    add_box(world, {-30, -9, -30}, {30, 9, 30}, world.add(material));
    add_floor(world, 30, -3, world.add(glowing(Vec3(1))));
    EXPECT_NEAR(see(world, looking({0, 0, 0}, 0), 2).x, 0.125, 1e-6);
    EXPECT_NEAR(see(world, looking({0, 0, 0}, 0), 0).x, 1, 1e-6) << "not without bounces";
}

// The inner one is like the outer, or denser.
TEST(Glass, StandsInGlass) {
    for (const double inner : {1.5, 2.0}) {
        RenderScene world;
        add_box(world, {-30, -6, -30}, {30, 0, 30}, world.add(glass()));
        add_box(world, {-20, -4, -20}, {20, -2, 20}, world.add(glass(float(inner))));
        add_ruler(world, 20, -7);
        const double angle = 60 * kDegree;
        const Vec3 seen = see(world, looking({0, 1, 0}, angle), 4);
        const double in = std::asin(std::sin(angle) / 1.5);
        const double deeper = std::asin(std::sin(angle) / inner);
        const double through = (1 - fresnel(angle, 1, 1.5)) * (1 - fresnel(in, 1.5, inner));
        EXPECT_NEAR(read_ruler(seen, 20),
                    2 * std::tan(angle) + 4 * std::tan(in) + 2 * std::tan(deeper), 0.02);
        EXPECT_NEAR(seen.y, through * through, 1e-4);
    }
}

TEST(Glass, TintsByItsColourAndLeavesTheRestMatt) {
    RenderScene world;
    world.scene.environment.ambient = Vec3(0.5f);
    scene::Material material = pane();
    material.transmission = 0.75f;
    material.base_color = {1, 0.5f, 0.25f, 1};
    add_floor(world, 30, 0, world.add(material));
    add_floor(world, 30, -1, world.add(glowing(Vec3(2)))); // and black: 2 is all
    const Vec3 seen = see(world, looking({0, 1, 0}, 0), 1);
    const double r = 0.04, mirrored = 2 * r / (1 + r);
    for (int k = 0; k < 3; ++k) {
        const double color = std::pow(0.5, k);
        const double expected = (1 - mirrored) * color * (0.75 * 2 + 0.25 * 0.5);
        EXPECT_NEAR(seen[k], expected, 1e-5) << "the sky that is mirrored is black";
    }
}

TEST(Pane, LetsLightGoStraightOn) {
    for (const double angle : {0.0, 60.0, 80.0}) {
        RenderScene world;
        add_floor(world, 90, 0, world.add(pane()));
        add_ruler(world, 40, -1);
        const Vec3 seen = see(world, looking({0, 1, 0}, angle * kDegree), 1);
        const double r = fresnel(angle * kDegree, 1, 1.5);
        EXPECT_NEAR(read_ruler(seen, 40), 2 * std::tan(angle * kDegree), 0.02);
        EXPECT_NEAR(seen.y, 1 - 2 * r / (1 + r), 1e-5);
    }
}

TEST(Pane, LetsLampsShineThrough) {
    const auto lit = [](float transmission) {
        RenderScene world;
        scene::Material white;
        white.double_sided = true;
        add_floor(world, 10, 0, world.add(white));
        scene::Material material = pane();
        material.transmission = transmission;
        add_floor(world, 10, 3, world.add(material));
        scene::Light lamp;
        lamp.position = {0, 4, 0};
        lamp.intensity = Vec3(100);
        world.add(lamp);
        return see(world, looking({0, 1, 0}, 0), 0).x;
    };
    EXPECT_GT(lit(1), 0);
    EXPECT_GT(lit(0.6f), 0);
    EXPECT_EQ(lit(0.5f), 0) << "more is swallowed than not: it casts a shadow";
    EXPECT_EQ(lit(0), 0);
}

} // namespace
} // namespace peregrine::test
