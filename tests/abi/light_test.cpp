// Candela and lux: what lamps of each fall-off give a white wall, against formulas in double.
#include "lamp_wall.h"

#include <algorithm>

namespace peregrine::test {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();
constexpr rt_falloff kAll[] = {RT_FALLOFF_SCHLICK_LINEAR, RT_FALLOFF_LINEAR,
                               RT_FALLOFF_COSINE_LINEAR, RT_FALLOFF_WINDOWED_INVERSE_SQUARE,
                               RT_FALLOFF_INVERSE_SQUARE};
constexpr double kTolerance = 2e-5; // half of it because rays begin a little off the surface

bool is_inverse_square(rt_falloff falloff) {
    return falloff >= RT_FALLOFF_WINDOWED_INVERSE_SQUARE;
}

// As the header says it.
double formula(rt_falloff falloff, double d, double radius) {
    const double x = d / radius;
    if (x >= 1) return 0;
    const double cosine = std::cos(1.5707963267948966 * x);
    switch (falloff) {
    case RT_FALLOFF_SCHLICK_LINEAR:
        return 93.01 * (1 - x) * (1 - x) / (1 + 4.47 * x) / (radius * radius);
    case RT_FALLOFF_LINEAR:
        return 27.386 * (1 - x) / (radius * radius);
    case RT_FALLOFF_COSINE_LINEAR:
        return 42.054 * cosine * cosine * (1 - x) / (radius * radius);
    case RT_FALLOFF_WINDOWED_INVERSE_SQUARE:
        return (1 - std::pow(x, 4)) / (d * d);
    default:
        return 1 / (d * d);
    }
}

//        |
//   * -- | wall
//        |
TEST(Light, CandelaAreLuxAtAMetre) {
    const LampWall wall(10);
    for (const float radius : {10.0f, 30.0f, 1000.0f, 1e30f, kEndless}) {
        EXPECT_NEAR(wall.lux(lamp_at(1, 3, radius)), 3, 3 * 1.01e-4) << radius;
        EXPECT_NEAR(wall.lux(lamp_at(0.1, 3, radius)), 300, 300 * 5e-4) << radius;
    }
    rt_light_desc lamp = lamp_at(1, 3, 10); // as it was, and is for old hosts
    lamp.falloff = RT_FALLOFF_SCHLICK_LINEAR;
    EXPECT_NEAR(wall.lux(lamp), 3 * 0.5207, 1e-3);
}

TEST(Light, EachFalloffIsItsFormula) {
    for (const float radius : {0.01f, 1.0f, 7.0f, 300.0f, 1e5f})
        for (const double x : {0.003, 0.1, 0.25, 0.5, 0.8, 0.97, 0.9999, 1.001, 1.5}) {
            const double d = x * double(radius);
            const auto half = float(d);
            const LampWall behind(half), inside(half, 2 * half);
            for (const rt_falloff falloff : kAll) {
                rt_light_desc lamp = lamp_at(d, 5, radius);
                lamp.falloff = falloff;
                const double expected = 5 * formula(falloff, d, double(radius));
                // Near its end a curve is a difference: the error is that of x.
                const double error = kTolerance * expected + 1e-6 * 5 * 90 / std::pow(radius, 2);
                EXPECT_NEAR(behind.lux(lamp), expected, error)
                    << falloff << " " << radius << " " << x;
                EXPECT_NEAR(inside.lux(lamp), expected, error)
                    << falloff << " " << radius << " " << x;
            }
        }
}

TEST(Light, TheInverseSquareHoldsOverManyDecades) {
    for (double d = 1e-6; d < 2e9; d *= 10) {
        const LampWall wall(static_cast<float>(std::clamp(d, 1e-3, 1e3)));
        for (const rt_falloff falloff : {kAll[3], kAll[4]})
            for (const float radius : {kEndless, kLargest, 1e30f}) {
                rt_light_desc lamp = lamp_at(d, 2, radius);
                lamp.falloff = falloff;
                const double expected = 2 / (d * d);
                const double lift = d < 1e-3 ? 1e-2 : kTolerance; // rays begin off the surface
                EXPECT_NEAR(wall.lux(lamp) / expected, 1, lift) << d << " " << radius;
            }
    }
}

TEST(Light, ThePlainInverseSquareEndsAtItsRadius) {
    const LampWall wall(10);
    rt_light_desc lamp = lamp_at(2.001, 8, 2);
    lamp.falloff = RT_FALLOFF_INVERSE_SQUARE;
    EXPECT_EQ(wall.lux(lamp), 0);
    lamp.position[2] = 1.999;
    EXPECT_NEAR(wall.lux(lamp), 8 / (1.999 * 1.999), 1e-4);
}

//   *            the wall's middle sees the lamp at an angle
//     \   |
//       \ |
TEST(Light, ASlantingWallGetsTheCosineOfIt) {
    const LampWall wall(1);
    for (const rt_falloff falloff : kAll)
        for (const double x : {0.5, 2.0, 20.0, 300.0}) {
            rt_light_desc lamp = lamp_at(1, 3, 1000);
            lamp.position[0] = x;
            lamp.falloff = falloff;
            const double d = std::sqrt(1 + x * x);
            EXPECT_NEAR(wall.lux(lamp) / (3 * formula(falloff, d, 1000) / d), 1, 1e-4) << x;
        }
}

TEST(Light, ASpotFadesOverItsRim) {
    const LampWall wall(1);
    for (const rt_falloff falloff : kAll)
        for (const double degrees : {0.0, 10.0, 19.0, 21.0, 30.0, 39.0, 41.0}) {
            rt_light_desc lamp = lamp_at(1, 3, 5);
            lamp.type = RT_LIGHT_SPOT;
            lamp.falloff = falloff;
            lamp.cone_inner_cos = std::cos(20 * 0.0174532925f);
            lamp.cone_outer_cos = std::cos(40 * 0.0174532925f);
            const double angle = degrees * 0.0174532925;
            lamp.direction[0] = float(std::sin(angle)), lamp.direction[2] = -float(std::cos(angle));
            const double inner = double(lamp.cone_inner_cos), outer = double(lamp.cone_outer_cos);
            const double s = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
            const double expected = 3 * formula(falloff, 1, 5) * s * s * (3 - 2 * s);
            EXPECT_NEAR(wall.lux(lamp), expected, 3 * kTolerance) << falloff << " " << degrees;
        }
}

TEST(Light, AWindowWithoutAnEndIsNoWindow) {
    const LampWall wall(4);
    std::vector<float> pictures[2];
    for (const int i : {0, 1}) {
        rt_light_desc lamp = lamp_at(2, 5, kEndless);
        lamp.falloff = kAll[3 + i];
        rt_light light{};
        ASSERT_OK(rt_add_light(wall.scene(), &lamp, &light));
        pictures[i] = wall.picture(5, 32, 1);
        ASSERT_OK(rt_remove_light(wall.scene(), light));
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

// What a host that was compiled earlier describes: 72 bytes, with anything behind them.
TEST(Light, HostsFromBeforeTheChoiceKeepTheirLight) {
    const LampWall wall(4);
    std::vector<float> pictures[2];
    for (const bool old_host : {false, true}) {
        rt_light_desc lamp = lamp_at(2, 5, 8);
        lamp.falloff = RT_FALLOFF_SCHLICK_LINEAR;
        if (old_host) {
            lamp.struct_size = 72;
            lamp.falloff = 0x7f7f7f7f, lamp.fog_scatter = 77;
        }
        EXPECT_NEAR(wall.lux(lamp), 5 * formula(RT_FALLOFF_SCHLICK_LINEAR, 2, 8), 5 * kTolerance);
        rt_light light{};
        ASSERT_OK(rt_add_light(wall.scene(), &lamp, &light));
        pictures[old_host] = wall.picture(5, 32, 1);
        ASSERT_OK(rt_remove_light(wall.scene(), light));
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

rt_light_desc mixed_lamp(rt_light_type type, rt_falloff falloff) {
    rt_light_desc lamp = lamp_at(1 + 0.37 * falloff, 3, 9);
    lamp.type = type;
    lamp.position[0] = 0.8 * falloff - 1.7;
    lamp.falloff = falloff;
    return lamp;
}

TEST(Light, EveryInstructionSetGivesTheSameBits) {
    std::vector<float> first;
    for (const rt_isa isa : {RT_ISA_SCALAR, RT_ISA_SSE4, RT_ISA_AVX2, RT_ISA_AVX512, RT_ISA_BEST}) {
        const LampWall wall(4, 6, isa);
        if (!wall.is_supported()) continue;
        for (const rt_light_type type : {RT_LIGHT_POINT, RT_LIGHT_SPOT, RT_LIGHT_DIRECTIONAL})
            for (const rt_falloff falloff : kAll) {
                const rt_light_desc lamp = mixed_lamp(type, falloff);
                rt_light light{};
                ASSERT_OK(rt_add_light(wall.scene(), &lamp, &light));
            }
        const std::vector<float> pixels = wall.picture(5, 48, 1.2f);
        if (first.empty()) first = pixels;
        EXPECT_EQ(pixels, first) << isa;
    }
}

// In the wall, a hair before it, farther than floats square, tiny, endless and of any brightness:
// no lamp gives anything but numbers.
TEST(Light, NothingIsEverInfiniteOrNoNumber) {
    const LampWall wall(1);
    rt_material_desc gloss = rt_default_material_desc();
    for (float& part : gloss.specular) part = 0.5f;
    rt_material material{};
    ASSERT_OK(rt_add_material(wall.scene(), &gloss, &material));
    const std::vector<float> corners = {-1, -1, 1e-3f, 0, -1, 1e-3f, 0, 0, 1e-3f};
    rt_mesh_desc shiny = rt_default_mesh_desc();
    shiny.positions = array_of(corners, 3);
    shiny.index_type = RT_INDEX_NONE;
    shiny.material = material;
    rt_mesh mesh{};
    ASSERT_OK(rt_add_static_mesh(wall.scene(), &shiny, &mesh));
    for (const rt_light_type type : {RT_LIGHT_POINT, RT_LIGHT_SPOT})
        for (const rt_falloff falloff : kAll)
            for (const float radius : {1e-45f, 1e-30f, 1e-6f, 1.0f, 1e19f, kLargest, kEndless})
                for (const double z : {0.0, 1e-45, 1e-38, 1e-20, 1e-7, 1.0, 1e18, 1e30, 1e300})
                    for (const float candela : {1e-45f, 1.0f, 1e30f, kLargest}) {
                        if (radius == kEndless && !is_inverse_square(falloff)) continue;
                        rt_light_desc lamp = lamp_at(z, candela, radius);
                        lamp.type = type;
                        lamp.falloff = falloff;
                        lamp.casts_no_shadow = 1;
                        rt_light light{};
                        ASSERT_OK(rt_add_light(wall.scene(), &lamp, &light));
                        for (const float value : wall.picture(0.9, 3, 0.5f))
                            ASSERT_TRUE(std::isfinite(value) && value >= 0)
                                << value << ": " << falloff << " " << radius << " " << z << " "
                                << candela;
                        ASSERT_OK(rt_remove_light(wall.scene(), light));
                    }
}

// A start-up scene as modellers save it: a cube of 2 m and a lamp without an end.
TEST(Light, AStartUpSceneIsLit) {
    const LampWall top(1); // of the cube, turned to +z
    rt_light_desc lamp = lamp_at(5.90 - 1, 54.35f, kEndless);
    lamp.position[0] = 4.08, lamp.position[1] = 1.01;
    const double square = 4.08 * 4.08 + 1.01 * 1.01 + 4.9 * 4.9;
    EXPECT_NEAR(top.lux(lamp), 54.35 / square * 4.9 / std::sqrt(square), 1e-4);
}

} // namespace
} // namespace peregrine::test
