// More lamps than anyone needs, and odd ones among them.
#include "lamp_wall.h"

namespace peregrine::test {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

rt_light add(rt_scene scene, const rt_light_desc& lamp) {
    rt_light light{};
    EXPECT_OK(rt_add_light(scene, &lamp, &light));
    return light;
}

// What they give adds up, as it would one by one.
TEST(ManyLights, AMillionLampsAtOnePoint) {
    constexpr uint32_t kLamps = 1'000'000;
    const LampWall wall(10);
    rt_light_desc lamp = lamp_at(1, 1e-3f, 2);
    lamp.casts_no_shadow = 1;
    for (uint32_t i = 0; i < kLamps; ++i) add(wall.scene(), lamp);
    const double radiance = double(wall.picture(5, 1, 0.01f)[0]);
    const double expected = 1e-3 * kLamps * (1 - 1 / 16.0) / 3.14159265358979324;
    EXPECT_NEAR(radiance / expected, 1, 0.05) << "a float's sum of a million";
}

// They reach nothing, everything, or it is hard to say; all others are lit as without them.
TEST(ManyLights, OddOnesAmongThem) {
    const LampWall wall(10);
    for (int i = 0; i < 100; ++i) {
        rt_light_desc lamp = lamp_at(0.5, 1, 1);
        lamp.position[0] = 0.15 * i - 7;
        add(wall.scene(), lamp);
    }
    const std::vector<float> before = wall.picture(12, 24, 1.2f);
    std::vector<rt_light> odd;
    for (const float radius : {1e-45f, 1e-30f, 1e30f, kLargest, kEndless})
        for (const double z : {0.0, 1e-30, -1e-7, -0.1, 1e18, 1e30, 1e300, -1e300})
            for (const float candela : {0.0f, 1e-45f, 1e-30f}) {
                rt_light_desc lamp = lamp_at(z, candela, radius);
                lamp.type = z == -0.1 ? RT_LIGHT_SPOT : RT_LIGHT_POINT;
                odd.push_back(add(wall.scene(), lamp));
            }
    const std::vector<float> after = wall.picture(12, 24, 1.2f);
    for (size_t i = 0; i < before.size(); ++i) {
        ASSERT_TRUE(std::isfinite(after[i]));
        ASSERT_NEAR(after[i], before[i], 1e-6f);
    }
    for (const rt_light light : odd) ASSERT_OK(rt_remove_light(wall.scene(), light));
    EXPECT_EQ(wall.picture(12, 24, 1.2f), before);
}

TEST(ManyLights, TheSameBitsWithEveryInstructionSet) {
    std::vector<float> first;
    for (const rt_isa isa : {RT_ISA_SCALAR, RT_ISA_SSE4, RT_ISA_AVX2, RT_ISA_AVX512, RT_ISA_BEST}) {
        const LampWall wall(10, 20, isa);
        if (!wall.is_supported()) continue;
        for (int i = 0; i < 300; ++i) {
            rt_light_desc lamp = lamp_at(0.1 + 0.01 * (i * 37 % 100), 1, 0.5f + 0.01f * float(i));
            lamp.position[0] = 0.07 * (i * 71 % 300) - 10;
            lamp.position[1] = 0.07 * (i * 113 % 300) - 10;
            add(wall.scene(), lamp);
        }
        const std::vector<float> pixels = wall.picture(12, 70, 1.2f);
        if (first.empty()) first = pixels;
        EXPECT_EQ(pixels, first) << isa;
    }
}

// A frame that is told to leave out what nobody sees, of lamps too dim to be seen one by one.
TEST(ManyLights, ManyDimOnesAreSeen) {
    const LampWall wall(10);
    for (int i = 0; i < 10'000; ++i) add(wall.scene(), lamp_at(2, 1e-3f, 8));
    ASSERT_OK(rt_commit_scene(wall.scene(), nullptr, nullptr));
    rt_camera camera = rt_default_camera();
    camera.position[2] = 4;
    std::vector<uint8_t> pictures[2];
    for (const bool exact : {false, true}) {
        std::vector<uint8_t>& pixels = pictures[exact];
        pixels.assign(4 * 16 * 16, 0);
        rt_frame_desc frame = rt_default_frame_desc();
        frame.pixels = pixels.data();
        frame.width = frame.height = 16;
        frame.light_block = 0;
        frame.least_light = exact ? 0 : 0.5f;
        ASSERT_OK(rt_render_frame(wall.scene(), &camera, &frame, nullptr));
    }
    EXPECT_GT(pictures[1][4 * 120], 100);
    for (size_t i = 0; i < pictures[0].size(); ++i)
        EXPECT_LE(std::abs(pictures[0][i] - pictures[1][i]), 1);
}

} // namespace
} // namespace peregrine::test
