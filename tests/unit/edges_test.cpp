#include "render/post/edge_rays.h"
#include "render/post/edges.h"
#include "render_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace peregrine::render {
namespace {

using math::Vec3;
using test::glowing;
using test::Picture;
using test::RenderScene;
using test::take_picture;

//   bright and leaning, before a dark wall; a lamp; a floor that is seen at a grazing angle
struct EdgeScene : RenderScene {
    explicit EdgeScene(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        scene::Material gray;
        gray.double_sided = true;
        const base::Handle wall = add(gray);
        add_quad({-20, -2, -20}, {20, -2, -20}, {20, 20, -20}, {-20, 20, -20}, wall);
        add_quad({-20, -2, 5}, {20, -2, 5}, {20, -2, -20}, {-20, -2, -20}, wall);
        add_quad({-3, -1, -8}, {2, -1.5f, -8}, {2.5f, 2, -8}, {-2.5f, 2.5f, -8},
                 add(glowing({0.9f, 0.6f, 0.3f})));
        scene::Light light;
        light.position = {4, 6, -4};
        light.intensity = Vec3(60);
        add(light);
        scene.environment.ambient = Vec3(0.02f);
    }
};

Frame edge_frame(uint32_t width, uint32_t height, uint32_t samples, float budget = 0) {
    Frame frame = test::float_frame(width, height);
    frame.tone_mapping = ToneMapping::filmic;
    frame.approximations.edge_samples = samples;
    frame.approximations.edge_budget = budget;
    return frame;
}

uint32_t count_different(const Picture& a, const Picture& b) {
    uint32_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 4)
        count += !std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]);
    return count;
}

double error_of(const Picture& picture, const Picture& truth) {
    double sum = 0;
    const uint32_t by = truth.width / picture.width;
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x) {
            Vec3 mean(0);
            for (uint32_t k = 0; k < by * by; ++k)
                mean += truth.at(x * by + k % by, y * by + k / by) / float(by * by);
            sum += double(glm::length(mean - picture.at(x, y)));
        }
    return sum;
}

TEST(Edges, TakeMoreRaysAndNothingElseDoes) {
    EdgeScene world;
    const Picture plain = take_picture(world, Camera{}, edge_frame(200, 150, 1));
    const Picture finer = take_picture(world, Camera{}, edge_frame(200, 150, 8));
    EXPECT_EQ(plain.stats.rays_edge, 0u);
    EXPECT_EQ(finer.stats.rays_primary, 200u * 150u);
    EXPECT_EQ(finer.stats.rays_edge % 7, 0u);
    const uint64_t edges = finer.stats.rays_edge / 7;
    EXPECT_GT(edges, 300u);
    EXPECT_LT(edges, 200u * 150u / 10) << "a floor at a grazing angle is no edge";
    EXPECT_LE(count_different(plain, finer), edges);
    const Picture truth = take_picture(world, Camera{}, edge_frame(1600, 1200, 1));
    EXPECT_LT(error_of(finer, truth), 0.35 * error_of(plain, truth));
    const Picture finest = take_picture(world, Camera{}, edge_frame(200, 150, 16));
    EXPECT_LT(error_of(finest, truth), error_of(finer, truth));
}

TEST(Edges, KeepToTheirBudget) {
    EdgeScene world;
    const Picture all = take_picture(world, Camera{}, edge_frame(200, 150, 4));
    uint64_t before = 0;
    for (const float budget : {1e-30f, 1e-4f, 0.01f, 0.03f, 0.05f, 1e30f}) {
        const Picture some = take_picture(world, Camera{}, edge_frame(200, 150, 4, budget));
        EXPECT_LE(double(some.stats.rays_edge), double(budget) * 200 * 150);
        EXPECT_GE(some.stats.rays_edge, before);
        before = some.stats.rays_edge;
    }
    EXPECT_EQ(before, all.stats.rays_edge);
    const Picture half = take_picture(world, Camera{}, edge_frame(200, 150, 4, 0.03f));
    EXPECT_GT(double(half.stats.rays_edge), 0.8 * 0.03 * 200 * 150) << "and use it";
}

TEST(Edges, AreTheSameForAnyThreadsAndInstructionSets) {
    EdgeScene plain(1, base::Isa::scalar);
    for (const ToneMapping tones : {ToneMapping::filmic, ToneMapping::clamp, ToneMapping::none})
        for (const uint32_t block : {1u, 8u}) {
            Frame frame = edge_frame(151, 133, 5, 0.1f);
            frame.tone_mapping = tones;
            frame.approximations.light_block = block;
            frame.approximations.light_tolerance = 0.05f;
            frame.approximations.render_width = block == 1 ? 0 : 97;
            const Picture expected = take_picture(plain, Camera{}, frame);
            EXPECT_GT(expected.stats.rays_edge, 100u);
            for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512})
                for (const uint32_t threads : {1u, 3u}) {
                    if (!base::is_available(isa)) continue;
                    EdgeScene world(threads, isa);
                    const Picture picture = take_picture(world, Camera{}, frame);
                    EXPECT_EQ(picture.pixels, expected.pixels) << int(isa);
                    EXPECT_EQ(picture.stats.rays_edge, expected.stats.rays_edge);
                }
        }
}

TEST(Edges, OfEqualColorsKeepThem) {
    RenderScene world;
    const base::Handle same = world.add(glowing({5e5f, 3, 0.01f}));
    world.add_quad({-20, -20, -20}, {20, -20, -20}, {20, 20, -20}, {-20, 20, -20}, same);
    world.add_quad({-3, -1, -8}, {2, -1.5f, -8}, {2.5f, 2, -8}, {-2.5f, 2.5f, -8}, same);
    const Picture plain = take_picture(world, Camera{}, edge_frame(64, 64, 1));
    const Picture finer = take_picture(world, Camera{}, edge_frame(64, 64, 16));
    EXPECT_EQ(finer.stats.rays_edge, 0u);
    EXPECT_EQ(plain.pixels, finer.pixels);
}

TEST(Edges, OfBytesAndHalvesAreThoseOfFloats) {
    EdgeScene world;
    world.scene.commit({});
    const scene::SnapshotStore::Pin pin(world.scene.snapshots);
    const Picture floats = take_picture(world, Camera{}, edge_frame(75, 41, 8));
    std::vector<uint8_t> rgba(75 * 41 * 4), bgra(rgba);
    Frame frame = edge_frame(75, 41, 8);
    frame.row_stride = 75 * 4;
    for (const auto& [format, pixels] :
         {std::pair(PixelFormat::rgba8_srgb, &rgba), std::pair(PixelFormat::bgra8_srgb, &bgra)}) {
        frame.format = format;
        frame.pixels = pixels->data();
        render_frame(*pin.get(), Camera{}, frame, world.scene.scheduler, &world.scene.memory,
                     nullptr);
    }
    for (size_t i = 0; i < rgba.size(); i += 4) {
        ASSERT_EQ(rgba[i], bgra[i + 2]);
        ASSERT_EQ(rgba[i + 1], bgra[i + 1]);
        ASSERT_EQ(rgba[i + 3], 255);
        const double x = double(floats.pixels[i]);
        const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
        ASSERT_NEAR(rgba[i], encoded * 255, 0.51);
    }
}

TEST(Edges, OfAnySizeAndPlace) {
    EdgeScene world(2);
    Camera inside;
    inside.position = {0, -2, -20}; // where the wall meets the floor
    for (const Extent extent : {Extent{1, 1}, Extent{16384, 1}, Extent{1, 16384}, Extent{33, 31}})
        for (const Camera& camera : {Camera{}, inside}) {
            Frame frame = edge_frame(extent.width, extent.height, 16, 0.5f);
            const Picture picture = take_picture(world, camera, frame);
            for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
            EXPECT_LE(picture.stats.rays_edge, uint64_t(extent.width) * extent.height / 2);
        }
}

TEST(EdgePattern, IsCenteredAndSpread) {
    for (uint32_t samples = 2; samples <= post::kMostEdgeSamples; ++samples) {
        const post::EdgePattern pattern(samples);
        ASSERT_EQ(pattern.count, samples - 1);
        double x = 0, y = 0;
        for (uint32_t k = 0; k < pattern.count; ++k) {
            x += double(pattern.x[k]) / samples;
            y += double(pattern.y[k]) / samples;
            EXPECT_LE(std::hypot(pattern.x[k], pattern.y[k]), 0.565f);
        }
        EXPECT_LT(std::hypot(x, y), samples > 3 ? 0.1 : 0.25) << samples;
    }
}

TEST(EdgeBudget, TakesTheStrongest) {
    std::vector<post::EdgeCounts> counts(2);
    counts[0].of_key[0] = 1000;
    counts[0].of_key[700] = 5;
    counts[1].of_key[700] = 5;
    counts[1].of_key[9000] = 3;
    EXPECT_EQ(post::least_key(counts, 2), 9001u);
    EXPECT_EQ(post::least_key(counts, 3), 701u);
    EXPECT_EQ(post::least_key(counts, 12), 701u);
    EXPECT_EQ(post::least_key(counts, 13), 1u);
    EXPECT_EQ(post::least_key(counts, 0), 9001u);
}

} // namespace
} // namespace peregrine::render
