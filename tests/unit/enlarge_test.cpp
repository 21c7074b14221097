#include "render_scene.h"

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

Frame smaller_frame(uint32_t width, uint32_t height, uint32_t columns, uint32_t rows) {
    Frame frame = test::float_frame(width, height);
    frame.tone_mapping = ToneMapping::clamp;
    frame.approximations.render_width = columns;
    frame.approximations.render_height = rows;
    return frame;
}

//   a wall of one colour, cut by a leaning edge
struct HalfPlane : RenderScene {
    explicit HalfPlane(uint32_t threads = 1, base::Isa isa = base::Isa::best)
        : RenderScene(threads, isa) {
        add_triangle({-90, -21, -10}, {90, 19, -10}, {90, -200, -10},
                     add(glowing({0.7f, 0.4f, 0.2f})));
        scene.environment.background = {0.05f, 0.1f, 0.2f};
    }
};

TEST(Enlarging, LeavesWholeFramesAlone) {
    HalfPlane world;
    const Picture plain = take_picture(world, Camera{}, smaller_frame(90, 70, 0, 0));
    EXPECT_EQ(plain.pixels, take_picture(world, Camera{}, smaller_frame(90, 70, 90, 70)).pixels);
    EXPECT_EQ(plain.stats.rays_primary, 90u * 70u);
}

TEST(Enlarging, KeepsEvenColors) {
    RenderScene world;
    world.add_quad({-90, -90, -10}, {90, -90, -10}, {90, 90, -10}, {-90, 90, -10},
                   world.add(glowing({0.7f, 0.4f, 0.2f})));
    for (const uint32_t side : {1u, 7u, 32u, 63u}) {
        const Picture picture = take_picture(world, Camera{}, smaller_frame(64, 65, side, side));
        EXPECT_EQ(picture.stats.rays_primary, side * side);
        for (uint32_t i = 0; i < 64 * 65; ++i) {
            const Vec3 color = picture.at(i % 64, i / 64);
            ASSERT_LT(glm::length(color - Vec3(0.7f, 0.4f, 0.2f)), 1e-5f);
        }
    }
}

TEST(Enlarging, FollowsAnEdgeWithoutHalos) {
    HalfPlane world;
    const Picture picture = take_picture(world, Camera{}, smaller_frame(128, 96, 64, 48));
    const Picture whole = take_picture(world, Camera{}, smaller_frame(128, 96, 0, 0));
    const Picture small = take_picture(world, Camera{}, smaller_frame(64, 48, 0, 0));
    double ours = 0, bilinear = 0;
    for (uint32_t y = 0; y < 96; ++y)
        for (uint32_t x = 0; x < 128; ++x) {
            const Vec3 color = picture.at(x, y);
            ASSERT_TRUE(color.x >= 0.0499f && color.x <= 0.7001f) << "between its neighbours";
            ours += double(glm::length(color - whole.at(x, y)));
            const float sx = std::max((float(x) + 0.5f) / 2 - 0.5f, 0.0f),
                        sy = std::max((float(y) + 0.5f) / 2 - 0.5f, 0.0f);
            const auto ix = uint32_t(sx), iy = uint32_t(sy);
            const uint32_t jx = std::min(ix + 1, 63u), jy = std::min(iy + 1, 47u);
            const Vec3 mixed = glm::mix(
                glm::mix(small.at(ix, iy), small.at(jx, iy), sx - float(ix)),
                glm::mix(small.at(ix, jy), small.at(jx, jy), sx - float(ix)), sy - float(iy));
            bilinear += double(glm::length(mixed - whole.at(x, y)));
        }
    EXPECT_LT(ours, 0.95 * bilinear);
}

TEST(Enlarging, IsTheSameForAnyThreadsAndInstructionSets) {
    HalfPlane plain(1, base::Isa::scalar);
    for (const ToneMapping tones : {ToneMapping::filmic, ToneMapping::clamp, ToneMapping::none}) {
        Frame frame = smaller_frame(151, 133, 90, 77);
        frame.tone_mapping = tones;
        const Picture expected = take_picture(plain, Camera{}, frame);
        for (const base::Isa isa : {base::Isa::sse4, base::Isa::avx2, base::Isa::avx512}) {
            if (!base::is_available(isa)) continue;
            HalfPlane world(3, isa);
            EXPECT_EQ(take_picture(world, Camera{}, frame).pixels, expected.pixels) << int(isa);
        }
    }
}

TEST(Enlarging, TakesAnySizes) {
    HalfPlane world(2);
    for (const Extent whole : {Extent{16384, 1}, Extent{1, 16384}, Extent{65, 3}})
        for (const uint32_t columns : {1u, 2u, whole.width / 2 + 1, whole.width})
            for (const uint32_t rows : {1u, whole.height / 2 + 1}) {
                if (columns > whole.width || rows > whole.height) continue;
                const Picture picture = take_picture(
                    world, Camera{}, smaller_frame(whole.width, whole.height, columns, rows));
                EXPECT_EQ(picture.stats.rays_primary, uint64_t(columns) * rows);
                for (const float value : picture.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
            }
}

TEST(Enlarging, ShowsTheSameFieldOfView) {
    HalfPlane world;
    const Pinhole whole(Camera{}, 100, 60), small(Camera{}, 100, 60, 25, 20);
    const Vec3 corner = whole.corner + whole.right * 100.0f + whole.down * 60.0f;
    const Vec3 other = small.corner + small.right * 25.0f + small.down * 20.0f;
    EXPECT_LT(glm::length(corner - other), 1e-5f);
    EXPECT_EQ(whole.corner, small.corner);
}

TEST(Enlarging, LeavesPlanesAndViewsWhole) {
    HalfPlane world;
    std::vector<float> depth(64 * 48), expected(64 * 48);
    Frame frame = smaller_frame(64, 48, 32, 24);
    frame.depth = {depth.data(), 64 * 4};
    const Picture picture = take_picture(world, Camera{}, frame);
    EXPECT_EQ(picture.stats.rays_primary, 64u * 48u + 32u * 24u);
    EXPECT_EQ(picture.pixels, take_picture(world, Camera{}, smaller_frame(64, 48, 32, 24)).pixels);
    frame = smaller_frame(64, 48, 0, 0);
    frame.depth = {expected.data(), 64 * 4};
    take_picture(world, Camera{}, frame);
    EXPECT_EQ(depth, expected);
    frame = smaller_frame(64, 48, 32, 24);
    frame.view = View::depth;
    EXPECT_EQ(take_picture(world, Camera{}, frame).stats.rays_primary, 64u * 48u);
}

} // namespace
} // namespace peregrine::render
