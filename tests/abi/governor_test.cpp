// The governor through the header.
#include "support.h"

#include <gtest/gtest.h>

namespace peregrine::test {
namespace {

rt_frame_desc frame_of(uint32_t width, uint32_t height) {
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = width;
    frame.height = height;
    return frame;
}

TEST(Governor, BeginsWithTheBestAndSaysWhatItChose) {
    rt_governor governor = rt_default_governor();
    rt_frame_desc frame = frame_of(1280, 720);
    frame.exposure = 3;
    ASSERT_OK(rt_govern_frame(&governor, &frame, nullptr));
    EXPECT_EQ(governor.level, 0u);
    EXPECT_GT(governor.level_count, 6u);
    EXPECT_NE(std::string(governor.text), "");
    EXPECT_EQ(frame.render_width, 1280u);
    EXPECT_GT(frame.edge_samples, 1u);
    EXPECT_EQ(frame.exposure, 3.0f) << "all else stays";
    EXPECT_EQ(frame.struct_size, sizeof frame);
}

TEST(Governor, GoesDownInTimeAndDependsOnItsArgumentsAlone) {
    rt_governor governor = rt_default_governor();
    rt_frame_stats last = rt_default_frame_stats();
    rt_frame_desc frame = frame_of(1280, 720);
    for (int i = 0; i < 300; ++i) {
        last.frame_ms = 5000;
        rt_governor copy = governor;
        rt_frame_desc other = frame;
        ASSERT_OK(rt_govern_frame(&governor, &frame, &last));
        ASSERT_OK(rt_govern_frame(&copy, &other, &last));
        EXPECT_EQ(std::memcmp(&copy, &governor, sizeof copy), 0);
        EXPECT_EQ(std::memcmp(&other, &frame, sizeof frame), 0);
    }
    EXPECT_EQ(governor.level, governor.level_count - 1);
    EXPECT_LT(frame.render_width, 1280u);
    EXPECT_LT(frame.render_height, 720u);
    EXPECT_EQ(frame.width, 1280u);
    last.frame_ms = 1;
    for (int i = 0; i < 300; ++i) ASSERT_OK(rt_govern_frame(&governor, &frame, &last));
    EXPECT_EQ(governor.level, 0u);
}

TEST(Governor, EveryLevelIsAFrame) {
    WorldGuard world;
    std::vector<uint32_t> pixels(37 * 23);
    for (uint32_t level = 0;; ++level) {
        rt_governor governor = rt_default_governor();
        governor.level = level;
        rt_frame_desc frame = frame_of(37, 23);
        frame.pixels = pixels.data();
        ASSERT_OK(rt_govern_frame(&governor, &frame, nullptr));
        const rt_camera camera = rt_default_camera();
        ASSERT_OK(rt_render_frame(world->scene, &camera, &frame, nullptr));
        if (level + 1 == governor.level_count) break;
    }
    rt_governor governor = rt_default_governor();
    governor.level = ~0u;
    rt_frame_desc frame = frame_of(1, 1);
    ASSERT_OK(rt_govern_frame(&governor, &frame, nullptr));
    EXPECT_EQ(governor.level, governor.level_count - 1);
    governor.level = 0;
    governor.target_ms = 0;
    ASSERT_OK(rt_govern_frame(&governor, &frame, nullptr));
    EXPECT_EQ(governor.level, governor.level_count - 1);
}

TEST(Governor, IsInTheTable) {
    EXPECT_EQ(rt_get_api(RT_API_VERSION)->govern_frame, &rt_govern_frame);
}

} // namespace
} // namespace peregrine::test
