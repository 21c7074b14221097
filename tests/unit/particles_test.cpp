#include "render_scene.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;
using test::take_picture;

//   a small wall five metres ahead, to the left of the middle
struct WallScene : RenderScene {
    explicit WallScene(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        scene::Material dark;
        dark.base_color = {0, 0, 0, 1};
        dark.double_sided = true;
        add_quad({-3, -1, -5}, {-0.5f, -1, -5}, {-0.5f, 1, -5}, {-3, 1, -5}, add(dark));
    }
};

using Many = std::vector<Particle>;

Picture show(RenderScene& world, const Many& particles, Frame frame) {
    frame.particles = particles;
    return take_picture(world, Camera{}, frame);
}
Picture show(RenderScene& world, const Many& particles, uint32_t width = 96, uint32_t height = 64) {
    return show(world, particles, test::float_frame(width, height));
}

double sum_of(const Picture& picture) {
    double sum = 0;
    for (size_t i = 0; i < picture.pixels.size(); i += 4) sum += double(picture.pixels[i]);
    return sum;
}

// Pixels a metre at depth 1.
double scale_of(uint32_t height) {
    return 1 / double(Pinhole(Camera{}, height, height).pixel_width);
}

TEST(Particles, ShineWhereTheyAre) {
    WallScene world;
    const Picture picture = show(world, {{{0, 0, -4}, 1, {8, 4, 2}}}, 97, 65);
    EXPECT_LT(glm::length(picture.at(48, 32) - Vec3(8, 4, 2)), 1e-5f);
    EXPECT_EQ(picture.stats.rays_particle, 1u);
    const double radius = scale_of(65) / 4;
    const auto distance = uint32_t(0.5 * radius);
    const double part = std::pow(1 - std::pow(distance / radius, 2), 2);
    EXPECT_NEAR(double(picture.at(48, 32 + distance).x), 8 * part, 1e-4);
    EXPECT_NEAR(double(picture.at(48 + distance, 32).y), 4 * part, 1e-4);
    EXPECT_EQ(picture.at(48 + uint32_t(radius) + 1, 32).x, 0);
    EXPECT_NEAR(sum_of(picture), 8 * 3.14159265 * radius * radius / 3, 0.5);
}

TEST(Particles, AreHiddenByWhatIsBeforeThem) {
    WallScene world;
    const Picture empty = show(world, {});
    EXPECT_EQ(show(world, {{{-1, 0, -6}, 0.4f, Vec3(9)}}).pixels, empty.pixels);
    EXPECT_EQ(show(world, {{{0, 0, 3}, 1, Vec3(9)}}).pixels, empty.pixels) << "behind the eye";
    EXPECT_EQ(show(world, {{{0, 90, -3}, 1, Vec3(9)}}).pixels, empty.pixels) << "beside the view";
    EXPECT_NE(show(world, {{{-1, 0, -4.9f}, 0.4f, Vec3(9)}}).pixels, empty.pixels);
    EXPECT_NE(show(world, {{{-1, 0, -5}, 0.4f, Vec3(9)}}).pixels, empty.pixels) << "on the wall";
}

// Its centre is seen, but a part of it is behind the wall.
TEST(Particles, EndAtWhatStandsInThem) {
    WallScene world;
    const Picture picture = show(world, {{{0, 0, -8}, 2, Vec3(1)}}, 128, 64);
    const double scale = scale_of(64);
    const auto wall = uint32_t(64 - 0.5 * scale / 5); // its right side
    for (uint32_t x = 0; x + 2 < wall; ++x) EXPECT_EQ(picture.at(x, 32).x, 0);
    EXPECT_GT(picture.at(wall + 2, 32).x, 0.3f);
}

TEST(Particles, OfLessThanAPixelKeepTheirLight) {
    WallScene world;
    const double radius = 0.01 * scale_of(64) / 4;
    ASSERT_LT(radius, 0.3);
    for (const float x : {0.0f, 0.031f, 0.07f}) {
        const double expected = 3.14159265 * radius * radius / 3;
        EXPECT_NEAR(sum_of(show(world, {{{x, 0.02f, -4}, 0.01f, Vec3(1)}})), expected,
                    0.35 * expected);
    }
}

TEST(Particles, AddUpInAnyOrder) {
    WallScene world;
    Many many;
    for (int i = 0; i < 300; ++i) {
        const auto k = float(i);
        many.push_back({{0.4f * std::sin(k), 0.4f * std::cos(2.3f * k), -3 - 0.01f * k},
                        0.1f + 0.01f * std::sin(3 * k),
                        {1, 0.02f * k, 1 / (1 + k)}});
    }
    const Picture picture = show(world, many);
    std::reverse(many.begin(), many.end());
    const Picture reversed = show(world, many);
    for (size_t i = 0; i < picture.pixels.size(); ++i)
        ASSERT_NEAR(picture.pixels[i], reversed.pixels[i], 1e-5f * (1 + picture.pixels[i]));
}

TEST(Particles, AMillionAtOnePointAreAMillionTimesAsBright) {
    WallScene world(2);
    const Many many(1000000, {{0, 0, -300}, 0.01f, Vec3(1)});
    const double one = sum_of(show(world, {many[0]}, 33, 33));
    EXPECT_NEAR(sum_of(show(world, many, 33, 33)) / one, 1e6, 3e4) << "floats round";
}

TEST(Particles, TakeAnySizes) {
    WallScene world(2);
    const Many many = {{{0, 0, -3}, 0.5f, Vec3(1)},       {{0, 0, -1e-30f}, 1, Vec3(1)},
                       {{0, 0, -1e30f}, 1e-30f, Vec3(1)}, {{0, 0, -2}, 1e38f, Vec3(1)},
                       {{1e30f, 0, -2}, 3, Vec3(1)},      {{0, 0, -2}, 1e-44f, Vec3(1)},
                       {{0, 0, 0}, 1, Vec3(1)},           {{0, 0, -2}, 2, Vec3(0)}};
    for (const Extent size : {Extent{1, 1}, Extent{16384, 1}, Extent{1, 16384}, Extent{65, 33}})
        for (const uint32_t samples : {1u, 3u}) {
            Frame frame = test::float_frame(size.width, size.height);
            frame.approximations.edge_samples = samples;
            for (const float value : show(world, many, frame).pixels)
                ASSERT_TRUE(value >= 0 && value < 100);
        }
}

TEST(Particles, AreDimmedByFog) {
    WallScene world;
    world.scene.fog = {0.25f, 50, 40, Vec3(0)};
    const Picture picture = show(world, {{{0, 0, -4}, 1, {8, 4, 2}}}, 97, 65);
    EXPECT_NEAR(picture.at(48, 32).x, 8 * std::exp(-1.0f), 1e-3f);
}

TEST(Particles, AreTheSameForAnyThreadsAndInstructionSets) {
    Many many;
    for (int i = 0; i < 3000; ++i) {
        const auto k = float(i);
        many.push_back({{2 * std::sin(k), std::cos(2.3f * k), -4 - 2 * std::sin(0.7f * k)},
                        0.02f + 0.015f * std::sin(3 * k),
                        {5, 2, 1 / (1 + k)}});
    }
    WallScene plain(1, base::Isa::scalar);
    for (const uint32_t columns : {143u, 90u})
        for (const uint32_t samples : {1u, 4u}) {
            Frame frame = test::float_frame(143, 101);
            frame.tone_mapping = ToneMapping::filmic;
            frame.bloom.strength = 0.4f;
            frame.approximations.render_width = columns;
            frame.approximations.edge_samples = samples;
            const Picture expected = show(plain, many, frame);
            for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
                if (!base::is_available(isa)) continue;
                WallScene world(3, isa);
                EXPECT_EQ(show(world, many, frame).pixels, expected.pixels);
            }
        }
}

} // namespace
} // namespace peregrine::render
