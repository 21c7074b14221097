#include "bad_input.h"

#include <functional>

namespace peregrine::test {
namespace {

constexpr uint32_t kWidth = 5, kHeight = 3;

class BadFrame : public BadInput {
protected:
    BadFrame() : pixels_(kWidth * kHeight * 4, 0xa5), camera_(world_camera()) {
        frame_.pixels = pixels_.data();
        frame_.width = kWidth;
        frame_.height = kHeight;
    }

    void refuse(rt_result expected, const std::string& words) {
        const Bytes before = pixels_;
        rt_frame_stats stats = rt_default_frame_stats();
        stats.rays_primary = 4711;
        expect_refused(rt_render_frame(scene(), &camera_, &frame_, &stats), expected, words);
        EXPECT_EQ(pixels_, before);
        EXPECT_EQ(stats.rays_primary, 4711u);
    }

    void refuse_camera(const std::function<void(rt_camera&)>& spoil, const std::string& words) {
        const rt_camera good = camera_;
        spoil(camera_);
        refuse(RT_ERROR_INVALID_ARGUMENT, words);
        camera_ = good;
    }

    void refuse_frame(const std::function<void(rt_frame_desc&)>& spoil, rt_result expected,
                      const std::string& words) {
        const rt_frame_desc good = frame_;
        spoil(frame_);
        refuse(expected, words);
        frame_ = good;
    }

    Bytes pixels_;
    rt_camera camera_;
    rt_frame_desc frame_ = rt_default_frame_desc();
};

TEST_F(BadFrame, Camera) {
    for (const float fov : {0.0f, -1.0f, 3.1415930f, 7.0f, kNan, kInfinity})
        refuse_camera([&](rt_camera& c) { c.vertical_fov = fov; }, "rt_camera.vertical_fov");
    for (int k = 0; k < 3; ++k) {
        for (const double value : {std::nan(""), double(kInfinity), 1e31, -1e300})
            refuse_camera([&](rt_camera& c) { c.position[k] = value; }, "rt_camera.position");
        for (const float value : {kNan, kInfinity}) {
            refuse_camera([&](rt_camera& c) { c.forward[k] = value; }, "rt_camera.forward");
            refuse_camera([&](rt_camera& c) { c.up[k] = value; }, "rt_camera.up");
        }
    }
    refuse_camera([](rt_camera& c) { std::memset(c.forward, 0, sizeof c.forward); },
                  "rt_camera.forward is the zero vector");
    refuse_camera([](rt_camera& c) { std::memset(c.up, 0, sizeof c.up); },
                  "rt_camera.up is the zero vector");
    for (const float scale : {1.0f, -2.0f, 1e-30f, 1e30f})
        refuse_camera(
            [&](rt_camera& c) {
                for (int k = 0; k < 3; ++k) c.up[k] = scale * c.forward[k];
            },
            "parallel");
}

TEST_F(BadFrame, Sizes) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    refuse_frame([](D& d) { d.pixels = nullptr; }, kArgument, "rt_frame_desc.pixels is null");
    refuse_frame([](D& d) { d.width = 0; }, kArgument, "rt_frame_desc.width is 0");
    refuse_frame([](D& d) { d.height = 0; }, kArgument, "rt_frame_desc.height is 0");
    refuse_frame([](D& d) { d.width = 16385; }, RT_ERROR_LIMIT, "width is 16385");
    refuse_frame([](D& d) { d.height = ~0u; }, RT_ERROR_LIMIT, "height");
    refuse_frame([](D& d) { d.row_stride = 19; }, kArgument, "row_stride is 19");
    refuse_frame([](D& d) { d.row_stride = ~0ull; }, RT_ERROR_LIMIT, "row_stride");
    refuse_frame([](D& d) { d.row_stride = 1ull << 63; }, RT_ERROR_LIMIT, "row_stride");
}

TEST_F(BadFrame, Fields) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    refuse_frame([](D& d) { d.format = RT_FORMAT_RGBA8_LINEAR; }, kArgument, "format");
    refuse_frame([](D& d) { d.format = 5; }, kArgument, "rt_frame_desc.format is 5");
    refuse_frame([](D& d) { d.format = -1; }, kArgument, "rt_frame_desc.format is -1");
    refuse_frame([](D& d) { d.view = 6; }, kArgument, "rt_frame_desc.view is 6");
    refuse_frame([](D& d) { d.view = -1; }, kArgument, "rt_frame_desc.view is -1");
    refuse_frame([](D& d) { d.tone_mapping = 3; }, kArgument, "tone_mapping is 3");
    refuse_frame([](D& d) { d.tone_mapping = RT_TONE_NONE; }, kArgument, "RT_TONE_NONE");
    refuse_frame([](D& d) { d.no_shadows = 2; }, kArgument, "no_shadows is 2");
    for (const float value : {0.0f, -1.0f, kNan, kInfinity}) {
        refuse_frame([&](D& d) { d.exposure = value; }, kArgument, "rt_frame_desc.exposure");
        refuse_frame([&](D& d) { d.depth_range = value; }, kArgument, "depth_range");
        refuse_frame([&](D& d) { d.steps_range = value; }, kArgument, "steps_range");
    }
}

TEST_F(BadFrame, Approximations) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    for (const uint32_t block : {2u, 3u, 5u, 12u, 17u, 32u, ~0u})
        refuse_frame([&](D& d) { d.light_block = block; }, kArgument, "light_block is");
    refuse_frame([](D& d) { d.texture_filter = 2; }, kArgument, "texture_filter is 2");
    refuse_frame([](D& d) { d.texture_filter = -1; }, kArgument, "texture_filter is -1");
    refuse_frame([](D& d) { d.edge_samples = 17; }, RT_ERROR_LIMIT, "edge_samples is 17");
    refuse_frame([](D& d) { d.render_width = d.width + 1; }, kArgument, "render_width is");
    refuse_frame([](D& d) { d.render_height = ~0u; }, kArgument, "render_height is");
    for (const float value : {-1.0f, kNan, kInfinity}) {
        refuse_frame([&](D& d) { d.light_tolerance = value; }, kArgument, "light_tolerance");
        refuse_frame([&](D& d) { d.least_light = value; }, kArgument, "least_light");
        refuse_frame([&](D& d) { d.edge_budget = value; }, kArgument, "edge_budget");
    }
}

TEST_F(BadFrame, Bounces) {
    using D = rt_frame_desc;
    refuse_frame([](D& d) { d.max_depth = 17; }, RT_ERROR_LIMIT,
                 "rt_frame_desc.max_depth is 17; at most 16 is supported");
    refuse_frame([](D& d) { d.max_depth = ~0u; }, RT_ERROR_LIMIT, "max_depth");
    for (const float value : {-0.1f, 1.1f, kNan, kInfinity})
        refuse_frame([&](D& d) { d.least_importance = value; }, RT_ERROR_INVALID_ARGUMENT,
                     "rt_frame_desc.least_importance");
}

TEST_F(BadFrame, Occlusion) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    for (const uint32_t block : {2u, 3u, 5u, 12u, 17u, 32u, ~0u})
        refuse_frame([&](D& d) { d.occlusion_block = block; }, kArgument, "occlusion_block is");
    refuse_frame([](D& d) { d.occlusion_samples = 257; }, RT_ERROR_LIMIT, "occlusion_samples is");
    for (const float value : {-1.0f, kNan})
        refuse_frame([&](D& d) { d.occlusion_range = value; }, kArgument, "occlusion_range is");
    for (const float value : {-1.0f, kNan, kInfinity}) {
        refuse_frame([&](D& d) { d.occlusion_tolerance = value; }, kArgument,
                     "occlusion_tolerance is");
        refuse_frame([&](D& d) { d.occlusion_normal_tolerance = value; }, kArgument,
                     "occlusion_normal_tolerance is");
        refuse_frame([&](D& d) { d.occlusion_plane_tolerance = value; }, kArgument,
                     "occlusion_plane_tolerance is");
    }
}

TEST_F(BadFrame, Bloom) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    for (const float value : {-0.1f, kNan, kInfinity}) {
        refuse_frame([&](D& d) { d.bloom = value; }, kArgument, "rt_frame_desc.bloom is");
        refuse_frame([&](D& d) { d.bloom_threshold = value; }, kArgument, "bloom_threshold");
        refuse_frame([&](D& d) { d.bloom_radius = value; }, kArgument, "bloom_radius is");
    }
    refuse_frame([](D& d) { d.bloom = 1.1f; }, kArgument, "rt_frame_desc.bloom is 1.1; it must");
    refuse_frame([](D& d) { d.bloom_radius = 2; }, kArgument, "bloom_radius is 2; it must");
}

TEST_F(BadFrame, Airlight) {
    refuse_frame([](rt_frame_desc& d) { d.airlight_shadows = 33; }, RT_ERROR_INVALID_ARGUMENT,
                 "rt_frame_desc.airlight_shadows is 33; it must be at most 32");
    for (const uint32_t block : {3u, 8u, ~0u})
        refuse_frame([&](rt_frame_desc& d) { d.airlight_block = block; }, RT_ERROR_INVALID_ARGUMENT,
                     "rt_frame_desc.airlight_block is");
    refuse_frame([](rt_frame_desc& d) { d.tinted_shadows = 2; }, RT_ERROR_INVALID_ARGUMENT,
                 "rt_frame_desc.tinted_shadows is 2");
    refuse_frame([](rt_frame_desc& d) { d.baked_light = 2; }, RT_ERROR_INVALID_ARGUMENT,
                 "rt_frame_desc.baked_light is 2");
    refuse_frame([](rt_frame_desc& d) { d.measure_luminance = 2; }, RT_ERROR_INVALID_ARGUMENT,
                 "rt_frame_desc.measure_luminance is 2");
}

TEST_F(BadFrame, Particles) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    const rt_particle good = {{0, 1, 2}, 0.1f, {1, 0, 3}};
    std::vector<rt_particle> particles(3, good);
    const auto refuse = [&](const char* words) {
        refuse_frame(
            [&](D& d) {
                d.particles = {particles.data(), particles.size(), 0, 0};
            },
            kArgument, words);
        particles[1] = particles[2] = good;
    };
    for (const float value : {0.0f, -1.0f, kNan, kInfinity}) {
        particles[1].radius = value;
        refuse("rt_frame_desc.particles: particle 1 has");
    }
    for (const float value : {-1.0f, kNan, kInfinity}) {
        particles[2].color[1] = value;
        refuse("particle 2 has");
        particles[2].position[0] = double(value) * 1e31;
        refuse("particle 2 has");
    }
    refuse_frame([](D& d) { d.particles.count = 1; }, kArgument, "particles");
    refuse_frame([&](D& d) { d.particles = {particles.data(), 3, 39, 0}; }, kArgument, "particles");
    refuse_frame(
        [&](D& d) {
            d.particles = {particles.data(), (1u << 24) + 1, 0, 0};
        },
        RT_ERROR_LIMIT, "particles");
    refuse_frame([&](D& d) { d.particles = {particles.data(), 3, 0, 1}; }, kArgument, "particles");
}

TEST_F(BadFrame, Planes) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using D = rt_frame_desc;
    std::vector<float> floats(kWidth * kHeight * 3, -7.0f);
    std::vector<uint32_t> ids(kWidth * kHeight * 2, 7);
    frame_.depth = frame_.normals = floats.data();
    frame_.triangle_ids = ids.data();
    frame_.mesh_ids = reinterpret_cast<rt_mesh*>(ids.data());
    refuse_frame([](D& d) { d.depth_row_stride = 19; }, kArgument, "depth_row_stride is 19");
    refuse_frame([](D& d) { d.triangle_row_stride = 1; }, kArgument, "triangle_row_stride is 1");
    refuse_frame([](D& d) { d.mesh_row_stride = 39; }, kArgument, "mesh_row_stride is 39");
    refuse_frame([](D& d) { d.normal_row_stride = 59; }, kArgument, "normal_row_stride is 59");
    refuse_frame([](D& d) { d.depth_row_stride = ~0ull; }, RT_ERROR_LIMIT, "depth_row_stride");
    refuse_frame([](D& d) { d.normal_row_stride = 1ull << 63; }, RT_ERROR_LIMIT, "normal_row_st");
    refuse_frame([](D& d) { d.pixels = nullptr, d.width = 0; }, kArgument, "width is 0");
    refuse_frame([](D& d) { d.pixels = nullptr, d.format = 9; }, kArgument, "format is 9");
    for (const float value : floats) EXPECT_EQ(value, -7.0f);
    for (const uint32_t value : ids) EXPECT_EQ(value, 7u);
    frame_.depth = frame_.normals = nullptr;
    frame_.triangle_ids = nullptr;
    frame_.mesh_ids = nullptr;
    refuse_frame([](D& d) { d.pixels = nullptr; }, kArgument, "no other plane is asked for");
}

// Formats and views at an odd address with odd strides; bytes between the rows stay.
TEST_F(BadFrame, StridesAndOddAddressesAreFine) {
    const struct {
        rt_pixel_format format;
        uint32_t bytes;
    } formats[] = {{RT_FORMAT_RGBA8_SRGB, 4},
                   {RT_FORMAT_BGRA8_SRGB, 4},
                   {RT_FORMAT_RGBA16F, 8},
                   {RT_FORMAT_RGBA32F, 16}};
    for (const auto& [format, bytes] : formats)
        for (rt_view view = RT_VIEW_SHADED; view <= RT_VIEW_OCCLUSION; ++view) {
            const uint32_t row = kWidth * bytes, stride = row + 3;
            Bytes tight(row * kHeight), loose(1 + stride * (kHeight - 1) + row, 0x5a);
            frame_.format = format;
            frame_.view = view;
            frame_.pixels = tight.data();
            frame_.row_stride = 0;
            ASSERT_OK(rt_render_frame(scene(), &camera_, &frame_, nullptr));
            frame_.pixels = &loose[1];
            frame_.row_stride = stride;
            ASSERT_OK(rt_render_frame(scene(), &camera_, &frame_, nullptr));
            for (uint32_t y = 0; y < kHeight; ++y) {
                EXPECT_EQ(std::memcmp(&tight[y * row], &loose[1 + y * stride], row), 0);
                if (y + 1 < kHeight) {
                    EXPECT_EQ(loose[1 + y * stride + row], 0x5a);
                    EXPECT_EQ(loose[stride * (y + 1)], 0x5a);
                }
            }
        }
}

TEST_F(BadFrame, ExtremesThatAreFine) {
    camera_.position[0] = 1e30;
    camera_.forward[2] = -1e-38f;
    camera_.forward[1] = 0;
    camera_.up[1] = 3e38f;
    EXPECT_OK(rt_render_frame(scene(), &camera_, &frame_, nullptr));
    camera_ = world_camera();
    for (const float fov : {1e-45f, 1e-3f, 3.1415925f}) {
        camera_.vertical_fov = fov;
        EXPECT_OK(rt_render_frame(scene(), &camera_, &frame_, nullptr));
    }
}

} // namespace
} // namespace peregrine::test
