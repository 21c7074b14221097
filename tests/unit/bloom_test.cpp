#include "render/film.h"
#include "render_scene.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::Picture;
using test::RenderScene;
using test::take_picture;

scene::Material glowing(const Vec3& color) {
    scene::Material material;
    material.base_color = {0, 0, 0, 1};
    material.emissive = color;
    material.double_sided = true;
    return material;
}

//   a lamp in the middle of a dark wall
struct Lamp : RenderScene {
    explicit Lamp(const Vec3& color = {20, 10, 5}, uint32_t threads = 1,
                  base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        add_quad({-0.7f, -0.4f, -10}, {0.7f, -0.4f, -10}, {0.7f, 0.4f, -10}, {-0.7f, 0.4f, -10},
                 add(glowing(color)));
        scene.environment.background = {0.02f, 0.03f, 0.04f};
    }
};

Frame blooming(uint32_t width, uint32_t height, float strength, float radius = 0.1f) {
    Frame frame = test::float_frame(width, height);
    frame.bloom = {strength, 1, radius};
    return frame;
}

double sum_of(const Picture& picture, int channel) {
    double sum = 0;
    for (size_t i = size_t(channel); i < picture.pixels.size(); i += 4)
        sum += double(picture.pixels[i]);
    return sum;
}

TEST(Bloom, KeepsTheLightOfAPicture) {
    Lamp world;
    const Picture plain = take_picture(world, Camera{}, blooming(160, 144, 0));
    for (const float strength : {0.1f, 0.5f, 1.0f}) {
        const Picture picture = take_picture(world, Camera{}, blooming(160, 144, strength));
        EXPECT_GT(picture.at(80, 60).x, plain.at(80, 60).x + 0.001f) << "beside the lamp";
        EXPECT_LT(picture.at(80, 72).x, plain.at(80, 72).x - 0.1f) << "in the middle of it";
        for (int c = 0; c < 3; ++c) {
            const double sum = sum_of(plain, c);
            EXPECT_NEAR(sum_of(picture, c), sum, 2e-5 * sum);
        }
    }
}

TEST(Bloom, IsTheSameOnAllSides) {
    Lamp world;
    const Picture picture = take_picture(world, Camera{}, blooming(128, 96, 1, 0.3f));
    for (uint32_t y = 0; y < 96; ++y)
        for (uint32_t x = 0; x < 128; ++x) {
            const Vec3 here = picture.at(x, y);
            ASSERT_LT(glm::length(here - picture.at(127 - x, y)), 1e-5f * glm::length(here));
            ASSERT_LT(glm::length(here - picture.at(x, 95 - y)), 1e-5f * glm::length(here));
        }
}

TEST(Bloom, LeavesEvenPicturesAsTheyAre) {
    const Vec3 color(7, 3, 0.5f);
    RenderScene world;
    world.scene.environment.background = color;
    for (const Extent size : {Extent{1, 1}, Extent{3, 2}, Extent{97, 64}, Extent{700, 5}})
        for (const float radius : {0.0f, 0.2f, 1.0f}) {
            const Picture picture =
                take_picture(world, Camera{}, blooming(size.width, size.height, 1, radius));
            for (uint32_t i = 0; i < size.width * size.height; ++i)
                ASSERT_LT(glm::length(picture.at(i % size.width, i / size.width) - color), 2e-5f);
        }
}

TEST(Bloom, LeavesAloneWhatIsNotTooBright) {
    Lamp world({0.9f, 0.5f, 0.2f});
    const Picture plain = take_picture(world, Camera{}, blooming(80, 60, 0));
    EXPECT_EQ(take_picture(world, Camera{}, blooming(80, 60, 1)).pixels, plain.pixels);
    Frame frame = blooming(80, 60, 1);
    frame.exposure = 2; // 0.9 is now beyond the threshold
    EXPECT_NE(take_picture(world, Camera{}, frame).pixels, plain.pixels);
}

TEST(Bloom, OfOnePixelIsBounded) {
    Lamp world(Vec3(1e9f));
    Frame frame = blooming(3, 3, 1, 1);
    frame.format = PixelFormat::rgba32f;
    const Picture picture = take_picture(world, Camera{}, frame);
    EXPECT_LE(picture.at(0, 0).x, 64);
    EXPECT_EQ(sane_radiance(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(sane_radiance(-1), 0);
    EXPECT_LE(sane_radiance(std::numeric_limits<float>::infinity()), 1e12f);
}

TEST(Bloom, TakesAnySizes) {
    Lamp world(Vec3(50), 2);
    for (const Extent size : {Extent{16384, 1}, Extent{1, 16384}, Extent{513, 3}, Extent{31, 33}}) {
        Frame frame = blooming(size.width, size.height, 0.5f, 1);
        for (const uint32_t samples : {1u, 3u}) {
            frame.approximations.edge_samples = samples;
            const Picture picture = take_picture(world, Camera{}, frame);
            for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value <= 51);
        }
    }
}

// With edges the pixels that have none are as without; the lamp's light lies over both.
TEST(Bloom, GoesWithEdges) {
    Lamp world;
    Frame frame = blooming(150, 110, 0.6f, 0.2f);
    frame.tone_mapping = ToneMapping::filmic;
    const Picture plain = take_picture(world, Camera{}, frame);
    frame.approximations.edge_samples = 4;
    const Picture picture = take_picture(world, Camera{}, frame);
    uint32_t different = 0;
    for (size_t i = 0; i < plain.pixels.size(); i += 4)
        different += plain.pixels[i] != picture.pixels[i];
    EXPECT_GT(picture.stats.rays_edge, 0u);
    EXPECT_GT(different, 0u);
    EXPECT_LE(different, picture.stats.rays_edge / 3);
}

TEST(Bloom, IsTheSameForAnyThreadsAndInstructionSets) {
    Lamp plain({30, 9, 2}, 1, base::Isa::scalar);
    for (const uint32_t columns : {143u, 90u})
        for (const uint32_t samples : {1u, 4u}) {
            Frame frame = blooming(143, 101, 0.7f, 0.5f);
            frame.tone_mapping = ToneMapping::filmic;
            frame.approximations.render_width = columns;
            frame.approximations.edge_samples = samples;
            const Picture expected = take_picture(plain, Camera{}, frame);
            for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
                if (!base::is_available(isa)) continue;
                Lamp world({30, 9, 2}, 3, isa);
                EXPECT_EQ(take_picture(world, Camera{}, frame).pixels, expected.pixels);
            }
        }
}

} // namespace
} // namespace peregrine::render
