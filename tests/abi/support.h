// What the tests of the door share: a small scene with everything in it, and its answers.
#pragma once

#include <peregrine/rt.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace peregrine::test {

inline std::string describe(rt_result result) {
    return std::string(rt_get_result_name(result)) + ": " + rt_get_last_error();
}

#define ASSERT_OK(call)                                                                            \
    do {                                                                                           \
        const rt_result ok_result = (call);                                                        \
        ASSERT_EQ(ok_result, RT_OK) << describe(ok_result);                                        \
    } while (0)
#define EXPECT_OK(call)                                                                            \
    do {                                                                                           \
        const rt_result ok_result = (call);                                                        \
        EXPECT_EQ(ok_result, RT_OK) << describe(ok_result);                                        \
    } while (0)

template <class T>
rt_array array_of(const std::vector<T>& values, uint64_t count, uint32_t stride = 0) {
    return {values.data(), count, stride, 0};
}

//      y
//      |   [ lift ]      a dynamic square at height `lift_height`, masked material
//      |   ________      the ground, static, 8 x 8 cells
//      +------------ x   a point light above, a sun
struct World {
    rt_scene scene{};
    rt_texture texture{};
    rt_material material{}; // of the ground
    rt_material fence{};    // of the lift, masked
    rt_mesh ground{};
    rt_mesh lift{};
    rt_light lamp{};
    rt_light sun{};
};

// The four corners of the lift, counter-clockwise from above.
std::vector<float> lift_corners(float height);

// Describes everything in `world.scene`; the first result that is not RT_OK, if any.
rt_result describe_world(World& world);
rt_result move_lift(const World& world, float height);

// Creates, describes and commits.
rt_result make_world(World& world, const rt_scene_desc& desc = rt_default_scene_desc());

// A destroyed world in the end.
class WorldGuard {
public:
    explicit WorldGuard(const rt_scene_desc& desc = rt_default_scene_desc()) {
        const rt_result result = make_world(world_, desc);
        EXPECT_EQ(result, RT_OK) << describe(result);
    }
    ~WorldGuard() { EXPECT_EQ(rt_destroy_scene(world_.scene), RT_OK); }
    WorldGuard(const WorldGuard&) = delete;
    WorldGuard& operator=(const WorldGuard&) = delete;

    const World& operator*() const { return world_; }
    World* operator->() { return &world_; }

private:
    World world_;
};

// Everything that a fixed set of queries says about a scene, as bytes.
using Bytes = std::vector<unsigned char>;
Bytes answers(rt_scene scene);

// The pixels of a small frame; empty if it failed.
Bytes render(rt_scene scene, uint32_t width = 48, uint32_t height = 40);

rt_camera world_camera();
std::vector<rt_ray> world_rays();

} // namespace peregrine::test
