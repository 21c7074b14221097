#include "render/post/display_curve.h"
#include "render/post/half.h"
#include "render_scene.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using post::DisplayCurve;
using post::filmic_tone;
using post::to_half;

int exact_srgb(double x) {
    if (x >= 1) return 255;
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return int(std::floor(encoded * 255.0 + 0.5));
}

int exact_filmic(double x) {
    return exact_srgb(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

// Every 61st float from 0 to 16, and where the code changes all floats around.
void expect_exact(const DisplayCurve& curve, int (*exact)(double)) {
    int previous = 0;
    for (uint32_t bits = 0; bits <= 0x41800000u; bits += 61) {
        const int code = curve.encode(std::bit_cast<float>(bits));
        ASSERT_EQ(code, exact(double(std::bit_cast<float>(bits)))) << std::bit_cast<float>(bits);
        for (uint32_t near = bits - 61; code != previous && near < bits; ++near)
            ASSERT_EQ(int(curve.encode(std::bit_cast<float>(near))),
                      exact(double(std::bit_cast<float>(near))));
        previous = code;
    }
    EXPECT_EQ(previous, 255);
}

TEST(DisplayCurve, EqualsTheExactFormulaRounded) {
    expect_exact(DisplayCurve::clamp(), exact_srgb);
    expect_exact(DisplayCurve::filmic(), exact_filmic);
}

TEST(DisplayCurve, TakesAnyFloat) {
    for (const DisplayCurve* curve : {&DisplayCurve::clamp(), &DisplayCurve::filmic()}) {
        EXPECT_EQ(curve->encode(-1.0f), 0);
        EXPECT_EQ(curve->encode(0.0f), 0);
        EXPECT_EQ(curve->encode(20.0f), 255);
        EXPECT_EQ(curve->encode(std::numeric_limits<float>::infinity()), 255);
        EXPECT_EQ(curve->encode(-std::numeric_limits<float>::infinity()), 0);
        EXPECT_EQ(curve->encode(std::numeric_limits<float>::quiet_NaN()), 0);
    }
}

double half_value(uint32_t half) {
    const int exponent = int(half >> 10 & 31);
    const int mantissa = int(half & 1023);
    const double magnitude =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024, exponent - 25);
    return half & 0x8000 ? -magnitude : magnitude;
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
    for (uint32_t half = 0; half < 0x7bff; ++half) {
        const double here = half_value(half), next = half_value(half + 1);
        const auto middle = float((here + next) / 2); // exact
        EXPECT_EQ(to_half(float(here)), half);
        EXPECT_EQ(to_half(middle), half & 1 ? half + 1 : half);
        EXPECT_EQ(to_half(std::nextafter(middle, 0.0f)), half);
        EXPECT_EQ(to_half(std::nextafter(middle, 1e9f)), half + 1);
        EXPECT_EQ(to_half(-float(here)), half | 0x8000);
    }
}

TEST(Half, KnowsTheEnds) {
    EXPECT_EQ(to_half(65504.0f), 0x7bff);
    EXPECT_EQ(to_half(65519.0f), 0x7bff);
    EXPECT_EQ(to_half(65520.0f), 0x7c00);
    EXPECT_EQ(to_half(std::numeric_limits<float>::infinity()), 0x7c00);
    EXPECT_EQ(to_half(-1e30f), 0xfc00);
    EXPECT_EQ(to_half(1e-30f), 0);
    EXPECT_EQ(to_half(std::numeric_limits<float>::quiet_NaN()) & 0x7c00, 0x7c00);
    EXPECT_NE(to_half(std::numeric_limits<float>::quiet_NaN()) & 0x03ff, 0);
}

// An image of the background alone, in each format, with padding after each row.
class Formats : public testing::TestWithParam<PixelFormat> {};

TEST_P(Formats, WritesItsPixelsAndNothingElse) {
    test::RenderScene world;
    world.scene.environment.background = {0.25f, 0.5f, 4.0f};
    world.scene.commit({});
    const scene::SnapshotStore::Pin pin(world.scene.snapshots);
    Frame frame;
    frame.format = GetParam();
    frame.tone_mapping = ToneMapping::clamp;
    frame.exposure = 0.5f;
    frame.width = 45;
    frame.height = 37;
    const uint32_t pixel = bytes_per_pixel(frame.format);
    frame.row_stride = frame.width * pixel + 3 * 16;
    const size_t margin = 64;
    std::vector<uint8_t> memory(margin + frame.row_stride * frame.height + margin, 0xa5);
    frame.pixels = memory.data() + margin;
    FrameStats stats;
    render_frame(*pin.get(), Camera{}, frame, world.scene.scheduler, &world.scene.memory, &stats);
    EXPECT_EQ(stats.rays_primary, 45u * 37u);
    EXPECT_EQ(stats.rays_shadow, 0u);

    std::vector<uint8_t> expected(16);
    const float c[4] = {0.125f, 0.25f, 1, 1};
    if (pixel == 16) std::memcpy(expected.data(), c, 16);
    for (size_t k = 0; k < 4; ++k) {
        const uint16_t half = to_half(c[k]);
        if (pixel == 8) std::memcpy(expected.data() + 2 * k, &half, 2);
        const size_t place = frame.format == PixelFormat::bgra8_srgb && k < 3 ? 2 - k : k;
        if (pixel == 4) expected[place] = uint8_t(exact_srgb(double(c[k])));
    }
    for (size_t i = 0; i < memory.size(); ++i) {
        const size_t column = (i - margin) % frame.row_stride;
        const bool inside =
            i >= margin && i < memory.size() - margin && column < size_t(frame.width) * pixel;
        ASSERT_EQ(memory[i], inside ? expected[column % pixel] : 0xa5) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(All, Formats,
                         testing::Values(PixelFormat::rgba8_srgb, PixelFormat::bgra8_srgb,
                                         PixelFormat::rgba16f, PixelFormat::rgba32f));

TEST(ToneMapping, FollowsItsFormulas) {
    test::RenderScene world;
    world.scene.environment.background = {0.02f, 0.7f, 40.0f};
    Frame frame = test::float_frame(3, 2);
    frame.exposure = 2;
    const math::Vec3 raw = test::take_picture(world, Camera{}, frame).at(1, 1);
    EXPECT_EQ(raw, math::Vec3(0.02f, 0.7f, 40.0f)) << "none ignores exposure";
    frame.tone_mapping = ToneMapping::clamp;
    EXPECT_EQ(test::take_picture(world, Camera{}, frame).at(1, 1), math::Vec3(0.04f, 1, 1));
    frame.tone_mapping = ToneMapping::filmic;
    const math::Vec3 film = test::take_picture(world, Camera{}, frame).at(1, 1);
    for (int k = 0; k < 2; ++k) {
        const float x = raw[k] * 2;
        EXPECT_FLOAT_EQ(film[k], x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f));
    }
    EXPECT_EQ(film.z, 1.0f);
}

} // namespace
} // namespace peregrine::render
