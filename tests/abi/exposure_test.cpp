// Exposure that adapts, through the header.
#include "support.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

float adapt(rt_exposure& exposure, float mean, float seconds) {
    EXPECT_OK(rt_adapt_exposure(&exposure, mean, seconds));
    return exposure.exposure;
}

TEST(Exposure, TakesTheFirstViewAtOnce) {
    rt_exposure eye = rt_default_exposure();
    eye.adaptation = 1;
    EXPECT_FLOAT_EQ(adapt(eye, 0.09f, 0), 2);
    eye = rt_default_exposure();
    EXPECT_FLOAT_EQ(adapt(eye, 0.09f, 5), std::pow(2.0f, 0.7f));
    eye.adaptation = 0;
    eye.exposure = 0;
    EXPECT_FLOAT_EQ(adapt(eye, 0.001f, 5), 1);
}

TEST(Exposure, MakesUpForRatiosInTime) {
    rt_exposure eye = rt_default_exposure();
    eye.adaptation = 1;
    eye.exposure = 1;
    const float rest = std::exp(-1.0f);
    EXPECT_FLOAT_EQ(adapt(eye, 0.18f / 4, 1), std::pow(4.0f, 1 - rest));
    eye.exposure = 1;
    EXPECT_FLOAT_EQ(adapt(eye, 0.18f * 4, 0.4f), std::pow(0.25f, 1 - rest));

    // However the time is cut.
    rt_exposure other = eye;
    adapt(eye, 0.1f, 1);
    for (int i = 0; i < 10; ++i) adapt(other, 0.1f, 0.1f);
    EXPECT_NEAR(eye.exposure, other.exposure, 1e-5f);
    adapt(eye, 0.1f, 1e30f);
    EXPECT_FLOAT_EQ(eye.exposure, 1.8f);
    eye.darken_seconds = 0;
    EXPECT_FLOAT_EQ(adapt(eye, 0.18f, 0), 1);
}

TEST(Exposure, StaysWithinItsLimits) {
    constexpr float kMost = std::numeric_limits<float>::max();
    for (const float mean : {1e-45f, 1e-3f, 0.1f, 1e10f, kMost})
        for (const float before : {0.0f, 1e-30f, 1.0f, kMost})
            for (const float seconds : {0.0f, 0.01f, kMost}) {
                rt_exposure eye = rt_default_exposure();
                eye.exposure = before;
                const float now = adapt(eye, mean, seconds);
                ASSERT_TRUE(now >= eye.least && now <= eye.most) << mean << " " << before;
            }
    rt_exposure eye = rt_default_exposure();
    EXPECT_EQ(adapt(eye, 0, 1), 1.0f) << "nothing was measured";
    eye.exposure = 3;
    EXPECT_EQ(adapt(eye, 0, 1), 3.0f);
}

TEST(Exposure, RefusesWhatIsNoSight) {
    const auto refuse = [](auto change, float mean, float seconds, const char* words) {
        rt_exposure eye = rt_default_exposure();
        eye.exposure = 2;
        change(eye);
        const rt_exposure before = eye;
        EXPECT_EQ(rt_adapt_exposure(&eye, mean, seconds), RT_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(rt_get_last_error()).find(words), std::string::npos)
            << rt_get_last_error();
        EXPECT_EQ(std::memcmp(&before, &eye, sizeof eye), 0);
    };
    using E = rt_exposure;
    const float nan = std::nanf("");
    refuse([](E& e) { e.key = 0; }, 1, 1, "rt_exposure.key");
    refuse([](E& e) { e.adaptation = 1.5f; }, 1, 1, "rt_exposure.adaptation is 1.5");
    refuse([](E& e) { e.least = 0; }, 1, 1, "rt_exposure.least");
    refuse([](E& e) { e.least = 9; }, 1, 1, "rt_exposure.least is 9, above its most, 8");
    refuse([](E& e) { e.brighten_seconds = -1; }, 1, 1, "brighten_seconds");
    refuse([](E& e) { e.darken_seconds = -1; }, 1, 1, "darken_seconds");
    refuse([](E& e) { e.exposure = -1; }, 1, 1, "rt_exposure.exposure");
    refuse([](E&) {}, nan, 1, "mean_luminance");
    refuse([](E&) {}, 1, -1, "seconds");
}

// Of all pixels, before exposure, whatever the format.
TEST(Exposure, FramesMeasureTheirMean) {
    WorldGuard world;
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = 83;
    frame.height = 47;
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    std::vector<float> pixels(size_t{4} * frame.width * frame.height);
    frame.pixels = pixels.data();
    rt_frame_stats stats = rt_default_frame_stats();
    rt_camera camera = rt_default_camera();
    ASSERT_OK(rt_render_frame(world->scene, &camera, &frame, &stats));
    EXPECT_EQ(stats.mean_luminance, 0.0);
    frame.measure_luminance = 1;
    ASSERT_OK(rt_render_frame(world->scene, &camera, &frame, &stats));
    double sum = 0;
    for (size_t i = 0; i < pixels.size(); i += 4)
        sum += std::log(std::max(
            0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2], 1.0 / 1024));
    const double mean = std::exp(4 * sum / double(pixels.size()));
    EXPECT_NEAR(stats.mean_luminance, mean, 0.01 * mean);
    const double first = stats.mean_luminance;
    frame.exposure = 7;
    frame.bloom = 0.5f;
    frame.format = RT_FORMAT_RGBA8_SRGB;
    frame.tone_mapping = RT_TONE_FILMIC;
    ASSERT_OK(rt_render_frame(world->scene, &camera, &frame, &stats));
    EXPECT_EQ(stats.mean_luminance, first);
}

} // namespace
} // namespace peregrine::test
