// Shading programs of the host.
#include "program_world.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace peregrine::test {
namespace {

void shade_as_library(void*, const rt_program_batch* hits) {
    for (int k = 0; k < 3; ++k)
        for (uint32_t i = 0; i < hits->padded_count; ++i)
            hits->radiance[k][i] = hits->base_color[k][i] * hits->diffuse[k][i]
                                   + hits->highlight[k][i] + hits->emissive[k][i];
}

// The lift mirrors, lets through, and all is in fog.
void make_paths(const World& world) {
    rt_material_desc desc = rt_default_material_desc();
    desc.alpha_mode = RT_ALPHA_BLEND;
    desc.base_color[3] = 0.75f;
    desc.reflectivity = 0.5f;
    desc.double_sided = 1;
    ASSERT_OK(rt_update_material(world.scene, world.fence, &desc));
    const rt_fog fog = rt_default_fog();
    ASSERT_OK(rt_set_fog(world.scene, &fog));
}

TEST(Program, MayDoWhatTheLibraryDoesBitForBit) {
    std::vector<rt_frame_desc> frames(5, rt_default_frame_desc());
    frames[1].light_block = 8;
    frames[1].light_tolerance = 0.05f;
    frames[2].edge_samples = 4;
    frames[3].occlusion_range = 2;
    frames[4].max_depth = 0;
    for (const bool paths : {false, true}) {
        WorldGuard plain, programmed;
        if (paths) make_paths(*plain);
        if (paths) make_paths(*programmed);
        cover_ground(*plain, shaded_by({}));
        cover_ground(*programmed,
                     shaded_by(add_program(programmed->scene, kAll & ~uint32_t(RT_PROGRAM_RAYS),
                                           shade_as_library)));
        for (const rt_frame_desc& frame : frames) {
            const ProgramFrame expected = render_radiance(plain->scene, frame);
            const ProgramFrame found = render_radiance(programmed->scene, frame);
            EXPECT_EQ(found.pixels, expected.pixels) << paths << " " << &frame - frames.data();
            EXPECT_EQ(expected.stats.program_hits, 0u);
            EXPECT_GT(found.stats.program_hits, 1000u);
            EXPECT_EQ(found.stats.program_faults, 0u);
            EXPECT_EQ(found.stats.rays_shadow, expected.stats.rays_shadow);
            EXPECT_EQ(found.stats.rays_bounced, expected.stats.rays_bounced);
        }
    }
}

TEST(Program, WithoutLightAsksForNone) {
    WorldGuard world;
    const auto say = [](void* user, const rt_program_batch* hits) {
        for (uint32_t i = 0; i < hits->count; ++i)
            for (int k = 0; k < 3; ++k)
                hits->radiance[k][i] = user ? hits->diffuse[k][i] : hits->shading_normal[k][i] + 1;
    };
    uint64_t shadow_rays[2];
    int lit = 1;
    for (int* const user : {static_cast<int*>(nullptr), &lit}) {
        const uint32_t fields = user ? RT_PROGRAM_DIFFUSE : RT_PROGRAM_SHADING_NORMAL;
        cover_ground(*world, shaded_by(add_program(world->scene, fields, say, user)));
        const ProgramFrame frame = render_radiance(world->scene);
        shadow_rays[user != nullptr] = frame.stats.rays_shadow;
        // The ground lies in the lower half: its normals are still there.
        const float* const pixel = frame.on_ground();
        if (!user) {
            EXPECT_NEAR(pixel[1], 2, 0.01f);
        }
    }
    EXPECT_LT(shadow_rays[0], shadow_rays[1] / 4);
}

// What can't be.
struct Fault {
    float radiance, direction, weight;
    bool counts;

    static void shade(void* user, const rt_program_batch* hits) {
        const auto& fault = *static_cast<const Fault*>(user);
        for (uint32_t i = 0; i < hits->count; ++i) {
            hits->radiance[1][i] = fault.radiance;
            hits->ray_direction[1][i] = fault.direction;
            hits->ray_weight[2][i] = fault.weight;
        }
    }
};

TEST(Program, ThatSaysWhatCannotBeIsBlackAndCounted) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kMost = std::numeric_limits<float>::max();
    const Fault faults[] = {
        {0, 0, 0, false},        {kNan, 0, 0, true},       {-1, 0, 0, true},
        {kInfinity, 0, 0, true}, {-kInfinity, 1, 0, true}, {0, kNan, 1, true},
        {0, kInfinity, 1, true}, {0, 0, 1, true},          {0, 1, kNan, true},
        {0, 1, -1, true},        {0, 1, kInfinity, true},  {-0.0f, kNan, 0, false},
        {0, 1e-45f, 0, false},   {0, kMost, 0, false},
    };
    for (const uint32_t depth : {0u, 4u})
        for (Fault fault : faults) {
            WorldGuard world;
            cover_ground(*world, shaded_by(add_program(world->scene, RT_PROGRAM_RAYS, Fault::shade,
                                                       &fault)));
            rt_frame_desc desc = rt_default_frame_desc();
            desc.max_depth = depth;
            const ProgramFrame frame = render_radiance(world->scene, desc);
            EXPECT_EQ(frame.stats.program_faults, fault.counts ? frame.stats.program_hits : 0);
            EXPECT_EQ(frame.stats.rays_bounced, 0u);
            const float* const pixel = frame.on_ground();
            for (int k = 0; k < 3; ++k) EXPECT_EQ(pixel[k], 0) << &fault - faults;
        }
}

TEST(Program, MaySendRaysOfAnyLength) {
    for (const float length : {1e-45f, 1e-30f, 1.0f, 1e30f, std::numeric_limits<float>::max()}) {
        WorldGuard world;
        rt_environment environment = rt_default_environment();
        environment.background[2] = 3;
        ASSERT_OK(rt_set_environment(world->scene, &environment));
        Fault up = {0, length, 0.5f, false};
        cover_ground(*world,
                     shaded_by(add_program(world->scene, RT_PROGRAM_RAYS, Fault::shade, &up)));
        const ProgramFrame frame = render_radiance(world->scene);
        EXPECT_EQ(frame.stats.program_faults, 0u);
        EXPECT_EQ(frame.stats.rays_bounced, frame.stats.program_hits) << length;
        const float* const pixel = frame.on_ground();
        EXPECT_EQ(pixel[2], 1.5f) << length;
    }
}

// How many pixels differ by more than rounding.
size_t count_differences(const ProgramFrame& a, const ProgramFrame& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 4)
        for (size_t k = i; k < i + 3; ++k)
            if (!(std::fabs(a.pixels[k] - b.pixels[k]) < 1e-4f)) {
                ++count;
                break;
            }
    return count;
}

TEST(Program, MayMirror) {
    const auto mirror = [](void*, const rt_program_batch* hits) {
        const auto& [x, y, z] = hits->direction;
        const auto& [nx, ny, nz] = hits->shading_normal;
        for (uint32_t i = 0; i < hits->padded_count; ++i) {
            const float twice = 2 * (x[i] * nx[i] + y[i] * ny[i] + z[i] * nz[i]);
            hits->ray_direction[0][i] = x[i] - twice * nx[i];
            hits->ray_direction[1][i] = y[i] - twice * ny[i];
            hits->ray_direction[2][i] = z[i] - twice * nz[i];
            for (int k = 0; k < 3; ++k) hits->ray_weight[k][i] = 1e30f; // as 1
        }
    };
    WorldGuard plain, programmed;
    rt_material_desc desc = rt_default_material_desc();
    desc.reflectivity = 1;
    desc.base_color[0] = desc.base_color[1] = desc.base_color[2] = 0;
    cover_ground(*plain, desc);
    desc.reflectivity = 0;
    desc.program =
        add_program(programmed->scene,
                    RT_PROGRAM_RAYS | RT_PROGRAM_DIRECTION | RT_PROGRAM_SHADING_NORMAL, mirror);
    cover_ground(*programmed, desc);
    const ProgramFrame expected = render_radiance(plain->scene);
    const ProgramFrame found = render_radiance(programmed->scene);
    EXPECT_EQ(found.stats.rays_bounced, expected.stats.rays_bounced);
    EXPECT_LT(count_differences(expected, found), 20u);
}

TEST(Program, MayLetThrough) {
    const auto clear = [](void*, const rt_program_batch* hits) {
        for (int k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < hits->padded_count; ++i) {
                hits->ray_direction[k][i] = hits->direction[k][i];
                hits->ray_weight[k][i] = 1;
            }
    };
    WorldGuard world;
    cover_ground(*world, shaded_by(add_program(world->scene, RT_PROGRAM_RAYS | RT_PROGRAM_DIRECTION,
                                               clear)));
    const ProgramFrame found = render_radiance(world->scene);
    EXPECT_EQ(found.stats.rays_bounced, found.stats.program_hits);
    ASSERT_OK(rt_set_mesh_hidden(world->scene, world->ground, 1));
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    EXPECT_LT(count_differences(found, render_radiance(world->scene)), 20u);
}

TEST(Program, IsScaledByAlphaWhereItBlends) {
    const auto shine = [](void*, const rt_program_batch* hits) {
        for (uint32_t i = 0; i < hits->count; ++i) {
            hits->radiance[0][i] = 8;
            hits->ray_direction[1][i] = hits->ray_weight[1][i] = 1;
        }
    };
    WorldGuard world;
    rt_environment environment = rt_default_environment();
    environment.background[1] = 4;
    environment.background[2] = 16;
    ASSERT_OK(rt_set_environment(world->scene, &environment));
    rt_material_desc desc = shaded_by(add_program(world->scene, RT_PROGRAM_RAYS, shine));
    desc.alpha_mode = RT_ALPHA_BLEND;
    desc.base_color[3] = 0.25f;
    cover_ground(*world, desc);
    const ProgramFrame frame = render_radiance(world->scene);
    const float* const pixel = frame.on_ground();
    EXPECT_EQ(pixel[0], 0.25f * 8);
    EXPECT_EQ(pixel[1], 0.25f * 4 + 0.75f * 4);
    EXPECT_EQ(pixel[2], 0.75f * 16);
}

TEST(Program, ThatThrowsIsBlackAndCounted) {
    WorldGuard world;
    const auto thrower = [](void*, const rt_program_batch*) { throw std::runtime_error("no"); };
    cover_ground(*world, shaded_by(add_program(world->scene, RT_PROGRAM_RAYS, thrower)));
    const ProgramFrame frame = render_radiance(world->scene);
    EXPECT_GT(frame.stats.program_hits, 0u);
    EXPECT_EQ(frame.stats.program_faults, frame.stats.program_hits);
}

TEST(Program, IsLeftOutWhereNothingHasIt) {
    WorldGuard world;
    constexpr uint32_t kBits = RT_FEATURE_PROGRAMS | RT_FEATURE_PROGRAM_RAYS;
    rt_commit_report report = rt_default_commit_report();
    const auto left_out = [&](const rt_material_desc& desc) {
        EXPECT_OK(rt_update_material(world->scene, world->material, &desc));
        EXPECT_OK(rt_commit_scene(world->scene, nullptr, &report));
        return report.left_out & kBits;
    };
    const rt_program plain = add_program(world->scene, 0, shade_as_library);
    const rt_program asking = add_program(world->scene, RT_PROGRAM_RAYS, shade_as_library);
    EXPECT_EQ(left_out(shaded_by({})), kBits);
    EXPECT_EQ(left_out(shaded_by(plain)), uint32_t(RT_FEATURE_PROGRAM_RAYS));
    EXPECT_EQ(left_out(shaded_by(asking)), 0u);
}

TEST(Program, StaysWithSnapshotsThatHaveIt) {
    WorldGuard world;
    float glow = 2;
    const auto shine = [](void* user, const rt_program_batch* hits) {
        for (uint32_t i = 0; i < hits->count; ++i)
            hits->radiance[0][i] = *static_cast<const float*>(user);
    };
    const rt_program program = add_program(world->scene, 0, shine, &glow);
    cover_ground(*world, shaded_by(program));
    const ProgramFrame before = render_radiance(world->scene);
    rt_frame_desc held = rt_default_frame_desc();
    ASSERT_OK(rt_hold_snapshot(world->scene, &held.snapshot));
    EXPECT_EQ(rt_remove_program(world->scene, program), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(render_radiance(world->scene).pixels, before.pixels);
    cover_ground(*world, shaded_by({}));
    ASSERT_OK(rt_remove_program(world->scene, program));
    add_program(world->scene, 0, shade_as_library); // in its place
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    EXPECT_EQ(render_radiance(world->scene, held).pixels, before.pixels);
    EXPECT_NE(render_radiance(world->scene).pixels, before.pixels);
    ASSERT_OK(rt_release_snapshot(world->scene, held.snapshot));
}

} // namespace
} // namespace peregrine::test
