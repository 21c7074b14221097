// Light through glass and blended surfaces, against the formulas, in doubles.
#include "path_scene.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

double fresnel(double angle, double index) {
    const double c = std::cos(angle), t = std::sqrt(1 - std::pow(std::sin(angle) / index, 2));
    const double s = (c - index * t) / (c + index * t), p = (index * c - t) / (index * c + t);
    return (s * s + p * p) / 2;
}

double through_pane(double angle, double index) {
    const double once = fresnel(angle, index);
    return 1 - 2 * once / (1 + once);
}

scene::Material white() {
    scene::Material material;
    material.double_sided = true;
    return material;
}

scene::Material veil(float alpha) {
    scene::Material material = white();
    material.blended = true;
    material.base_color = {1, 0.2f, 0.2f, alpha};
    return material;
}

// A white floor, seen from just above it at (0, 0, 0), under light that comes at an angle.
struct Shadowed : RenderScene {
    Shadowed(double angle, bool is_sun, const std::function<void(Shadowed&)>& add_more) {
        add_floor(*this, 40, 0, add(white()));
        scene::Light light;
        const math::Vec3d toward(std::sin(angle), std::cos(angle), 0);
        if (is_sun) {
            light.type = scene::LightType::directional;
            light.direction = Vec3(-toward);
            light.intensity = Vec3(1);
        } else {
            light.position = 8.0 * toward;
            light.radius = std::numeric_limits<float>::infinity();
            light.falloff = scene::Falloff::inverse_square;
            light.intensity = Vec3(50);
        }
        add(light);
        add_more(*this);
    }
    using RenderScene::add;

    Vec3 light(bool tinted) {
        Camera camera = looking({0, 0.05, 0}, 0);
        Frame frame = float_frame(5, 5);
        frame.tinted_shadows = tinted;
        return take_picture(*this, camera, frame).at(2, 2);
    }
};

// What is left of the light.
Vec3 passed(double angle, const std::function<void(Shadowed&)>& add_more, bool is_sun = false) {
    Shadowed shadowed(angle, is_sun, add_more), open(angle, is_sun, [](Shadowed&) {});
    return shadowed.light(true) / open.light(true);
}

TEST(TintedShadows, OfBlendedSurfacesAreAsDarkAsTheyCover) {
    for (const float alpha : {0.0f, 0.25f, 0.75f, 1.0f})
        for (const bool is_sun : {false, true}) {
            const Vec3 left = passed(
                0.3, [&](Shadowed& world) { add_floor(world, 20, 2, world.add(veil(alpha))); },
                is_sun);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(left[k], 1 - alpha, 1e-6) << alpha << is_sun;
        }
}

TEST(TintedShadows, MultiplyAndCountAnEdgeOnce) {
    const Vec3 left = passed(0, [&](Shadowed& world) {
        const base::Handle sheet = world.add(veil(0.5f));
        for (const float y : {1.0f, 2.0f, 3.0f})
            add_floor(world, 20, y, sheet); // diagonals above 0
    });
    EXPECT_NEAR(left.x, 0.125, 1e-6);
}

TEST(TintedShadows, OfPanes) {
    for (const double angle : {0.0, 60 * kDegree}) {
        const Vec3 left = passed(angle, [&](Shadowed& world) {
            scene::Material tinted = pane();
            tinted.base_color = {1, 0.5f, 0.25f, 1};
            tinted.transmission = 0.75f;
            add_floor(world, 30, 2, world.add(tinted));
        });
        const double through = 0.75 * through_pane(angle, 1.5);
        EXPECT_NEAR(left.x, through, 1e-5);
        EXPECT_NEAR(left.y, 0.5 * through, 1e-5);
        EXPECT_NEAR(left.z, 0.25 * through, 1e-5);
    }
}

// From a sun and from a lamp, whose rays start at the lamp.
TEST(TintedShadows, OfSolidsByBeersLaw) {
    for (const bool is_sun : {false, true})
        for (const double angle : {0.0, 50 * kDegree}) {
            const Vec3 left = passed(
                angle,
                [&](Shadowed& world) {
                    scene::Material material = glass();
                    material.absorption = {float(std::log(2.0)), 0.25f, 0};
                    add_box(world, {-30, 1, -30}, {30, 3, 30}, world.add(material));
                },
                is_sun);
            const double metres = 2 / std::cos(angle);
            const double through = std::pow(1 - fresnel(angle, 1.5), 2);
            EXPECT_NEAR(left.x, through * std::pow(0.5, metres), 1e-5) << angle;
            EXPECT_NEAR(left.y, through * std::exp(-0.25 * metres), 1e-5) << angle;
            EXPECT_NEAR(left.z, through, 1e-5) << angle;
        }
}

// The floor and the lamp are both within.
TEST(TintedShadows, WithinASolid) {
    const Vec3 left = passed(0, [&](Shadowed& world) {
        scene::Material material = glass();
        material.absorption = Vec3(0.25f);
        add_box(world, {-30, -5, -30}, {30, 2, 30}, world.add(material));
        add_box(world, {-20, 0.5f, -20}, {20, 1, 20}, world.add(glass(1.5f))); // clear, as dense
    });
    EXPECT_NEAR(left.x, (1 - fresnel(0, 1.5)) * std::exp(-0.25 * 1.5),
                1e-4); // rays begin above the floor
}

TEST(TintedShadows, AreWholeOrNoneWithoutThem) {
    for (const float alpha : {0.25f, 0.75f}) {
        const auto sheet = [&](Shadowed& world) {
            add_floor(world, 20, 2, world.add(veil(alpha)));
        };
        Shadowed shadowed(0, false, sheet), open(0, false, [](Shadowed&) {});
        EXPECT_EQ(shadowed.light(false), alpha < 0.5f ? open.light(false) : Vec3(0));
    }
}

// More boxes than a snapshot has, and clusters of one mesh.
TEST(TintedShadows, AreFoundAmongManyPanes) {
    for (const bool is_sun : {false, true}) {
        const Vec3 left = passed(
            0.3,
            [&](Shadowed& world) {
                const base::Handle sheet = world.add(veil(0.25f));
                const auto mesh = world.make_mesh(sheet);
                for (int i = 0; i < 100; ++i) {
                    const float x = float(i % 10) * 3 - 15, z = float(i / 10) * 3 - 15;
                    world.add_quad({x, 5, z + 1}, {x + 1, 5, z + 1}, {x + 1, 5, z}, {x, 5, z},
                                   sheet);
                    for (const Vec3& corner : {Vec3(x, 1, z), Vec3(x + 3, 1, z), Vec3(x, 1, z + 3),
                                               Vec3(x + 3, 1, z + 3)})
                        mesh.data->positions.push_back(corner);
                    const auto first = uint32_t(4 * i);
                    mesh.surface->triangles.push_back({first, first + 2, first + 1});
                    mesh.surface->triangles.push_back({first + 1, first + 2, first + 3});
                }
                world.scene.meshes.insert({mesh.data});
            },
            is_sun);
        EXPECT_NEAR(left.x, 0.75, 1e-6) << is_sun;
    }
}

TEST(TintedShadows, AreDarkBeyondSixtyFourSurfaces) {
    for (const int count : {64, 65}) {
        const Vec3 left = passed(0, [&](Shadowed& world) {
            const base::Handle sheet = world.add(veil(1.0f / 64));
            for (int i = 0; i < count; ++i) add_floor(world, 20, 1 + 0.05f * float(i), sheet);
        });
        EXPECT_NEAR(left.x, count > 64 ? 0 : std::pow(63.0 / 64, 64), 1e-5) << count;
    }
}

TEST(TintedShadows, EndAtWhatIsOpaque) {
    const Vec3 left = passed(0, [&](Shadowed& world) {
        add_floor(world, 20, 2, world.add(veil(0.25f)));
        add_floor(world, 20, 3, world.add(white()));
    });
    EXPECT_EQ(left, Vec3(0));
}

} // namespace
} // namespace peregrine::test
