// What frames that are not exact look like beside the exact ones.
#include "support/flip.h"

#include "camera.h"
#include "cameras.h"
#include "gltf/import.h"
#include "stage.h"
#include "upload.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

constexpr uint32_t kWidth = 320, kHeight = 192;
constexpr double kMostMean = 0.02, kMostTile = 0.2; // FLIP; tiles of 32 x 32

using Pixels = std::vector<uint8_t>;

class Approximations : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        level_ = host::gltf::import_file(std::string(PEREGRINE_CONTENT "/") + GetParam() + ".glb");
        host::upload_level(stage_, level_, 0.1f);
        stage_.check(stage_.api().commit_scene(stage_.scene(), nullptr, nullptr), "building");
    }

    Pixels draw(const rt_camera& camera, const rt_frame_desc& options) {
        rt_frame_desc frame = options;
        Pixels pixels(size_t(kWidth) * kHeight * 4);
        frame.width = kWidth;
        frame.height = kHeight;
        frame.pixels = pixels.data();
        stage_.check(stage_.api().render_frame(stage_.scene(), &camera, &frame, &stats_),
                     "rendering a frame");
        return pixels;
    }
    // Blocks of 1: every pixel for itself.
    Pixels draw(const rt_camera& camera, uint32_t light_block) {
        rt_frame_desc options = rt_default_frame_desc();
        options.light_block = light_block;
        options.light_tolerance = 0.03f;
        return draw(camera, options);
    }

    std::vector<rt_camera> cameras() const {
        std::vector<rt_camera> all;
        for (const auto& camera : level_.cameras) all.push_back(host::camera_of(camera));
        return all;
    }

    static FlipMap compare(const Pixels& a, const Pixels& b) {
        return flip(a.data(), b.data(), kWidth, kHeight);
    }

    host::Stage stage_{*rt_get_api(RT_API_VERSION), 2, RT_ISA_BEST};
    host::Level level_;
    rt_frame_stats stats_ = rt_default_frame_stats();
};

TEST_P(Approximations, LightInBlocksIsNearTheExactFrame) {
    for (const rt_camera& camera : cameras())
        for (const uint32_t block : {4u, 8u, 16u}) {
            const Pixels exact = draw(camera, 1);
            EXPECT_EQ(stats_.light_points, uint64_t(kWidth) * kHeight);
            const uint64_t exact_rays = stats_.rays_shadow;
            const FlipMap error = compare(exact, draw(camera, block));
            EXPECT_LE(error.mean(), kMostMean);
            EXPECT_LE(error.worst_tile(32), kMostTile);
            EXPECT_LT(stats_.rays_shadow, exact_rays);
        }
}

TEST_P(Approximations, BlocksOfOnePixelAreExact) {
    const rt_camera camera = cameras().front();
    EXPECT_EQ(draw(camera, 0), draw(camera, 1));
}

TEST_P(Approximations, OcclusionInBlocksIsNearThatOfEachPixel) {
    for (const rt_camera& camera : cameras()) {
        rt_frame_desc options = rt_default_frame_desc();
        options.occlusion_range = 2;
        options.occlusion_block = 1;
        const Pixels exact = draw(camera, options);
        const uint64_t most_places = uint64_t(kWidth) * kHeight + stats_.rays_bounced;
        EXPECT_LE(stats_.rays_occlusion, most_places * options.occlusion_samples);
        const uint64_t exact_rays = stats_.rays_occlusion;
        for (const uint32_t block : {4u, 8u, 16u}) {
            options.occlusion_block = block;
            const FlipMap error = compare(exact, draw(camera, options));
            EXPECT_LE(error.mean(), kMostMean);
            EXPECT_LE(error.worst_tile(32), kMostTile / 2);
            EXPECT_LT(stats_.rays_occlusion, exact_rays);
        }
    }
}

// A picture that flickers changes more from frame to frame than the exact one does.
TEST_P(Approximations, ASlowPanDoesNotFlicker) {
    constexpr int kFrames = 12;
    constexpr double kStep = 0.0025; // radians: two thirds of a pixel
    rt_camera camera = cameras().front();
    const double x = camera.forward[0], z = camera.forward[2];
    double exact_change = 0, change = 0;
    Pixels last_exact, last;
    for (int k = 0; k < kFrames; ++k) {
        const double c = std::cos(k * kStep), s = std::sin(k * kStep);
        camera.forward[0] = float(c * x - s * z);
        camera.forward[2] = float(s * x + c * z);
        Pixels exact = draw(camera, 1), picture = draw(camera, 8);
        if (k > 0) {
            exact_change += compare(last_exact, exact).mean();
            change += compare(last, picture).mean();
        }
        last_exact.swap(exact);
        last.swap(picture);
    }
    EXPECT_LE(change, exact_change * 1.02);
}

INSTANTIATE_TEST_SUITE_P(Levels, Approximations, testing::Values("hall", "mill"),
                         [](const auto& info) { return std::string(info.param); });

} // namespace
} // namespace peregrine::test
