// The planes of visibility say what queries say, bit for bit.
#include "support.h"

#include <cmath>
#include <limits>

namespace peregrine::test {
namespace {

struct Planes {
    Planes(uint32_t w, uint32_t h)
        : width(w), height(h), depth(w * h, -1.0f), triangles(w * h, 7),
          meshes(w * h, rt_mesh{7, 7}), normals(size_t(w) * h * 3, -7.0f) {
        frame.width = w;
        frame.height = h;
        frame.depth = depth.data();
        frame.triangle_ids = triangles.data();
        frame.mesh_ids = meshes.data();
        frame.normals = normals.data();
    }

    uint32_t width, height;
    std::vector<float> depth;
    std::vector<uint32_t> triangles;
    std::vector<rt_mesh> meshes;
    std::vector<float> normals;
    rt_frame_desc frame = rt_default_frame_desc();
};

struct Vector {
    double x, y, z;
};

Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

Vector unit(const Vector& v) {
    const double scale = 1.0 / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x * scale, v.y * scale, v.z * scale};
}

// The rays of a frame; in float where the engine is.
std::vector<rt_ray> camera_rays(const rt_camera& camera, uint32_t width, uint32_t height) {
    const Vector forward =
        unit({double(camera.forward[0]), double(camera.forward[1]), double(camera.forward[2])});
    const Vector side =
        unit(cross(forward, {double(camera.up[0]), double(camera.up[1]), double(camera.up[2])}));
    const Vector up = cross(side, forward);
    const double pixel = 2.0 * std::tan(double(camera.vertical_fov) * 0.5) / double(height);
    const double half_width = pixel * 0.5 * double(width),
                 half_height = pixel * 0.5 * double(height);
    const double f[] = {forward.x, forward.y, forward.z}, s[] = {side.x, side.y, side.z},
                 u[] = {up.x, up.y, up.z};
    std::vector<rt_ray> rays;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            rt_ray ray = {};
            ray.t_max = std::numeric_limits<float>::infinity();
            for (int k = 0; k < 3; ++k) {
                const auto corner = float(f[k] - s[k] * half_width + u[k] * half_height);
                const auto right = float(s[k] * pixel), down = float(-u[k] * pixel);
                ray.origin[k] = float(camera.position[k]);
                ray.direction[k] = (corner + right * (float(x) + 0.5f)) + down * (float(y) + 0.5f);
            }
            rays.push_back(ray);
        }
    return rays;
}

class PlanesOf : public testing::Test {
protected:
    rt_scene scene() { return world_->scene; }

    // What queries say; single-sided surfaces are seen from their front only.
    std::vector<rt_hit> ask(uint32_t width, uint32_t height) {
        const std::vector<rt_ray> rays = camera_rays(world_camera(), width, height);
        std::vector<rt_hit> hits(rays.size());
        rt_query_desc desc = rt_default_query_desc();
        desc.rays = rays.data();
        desc.ray_count = rays.size();
        desc.hits = hits.data();
        desc.flags = RT_QUERY_ALPHA_TEST;
        desc.coherence = RT_COHERENCE_COMMON_ORIGIN;
        EXPECT_OK(rt_trace_query(scene(), &desc));
        return hits;
    }

    WorldGuard world_;
};

TEST_F(PlanesOf, AnySizeSayWhatQueriesSay) {
    const rt_camera camera = world_camera();
    const struct {
        uint32_t width, height;
    } sizes[] = {{1, 1}, {32, 32}, {33, 31}, {100, 70}, {64, 96}};
    for (const auto& [width, height] : sizes) {
        Planes planes(width, height);
        rt_frame_stats stats = rt_default_frame_stats();
        ASSERT_OK(rt_render_frame(scene(), &camera, &planes.frame, &stats));
        EXPECT_EQ(stats.rays_primary, uint64_t(width) * height);
        EXPECT_EQ(stats.rays_shadow, 0u);
        const std::vector<rt_hit> hits = ask(width, height);
        std::vector<rt_surface> surfaces(hits.size());
        ASSERT_OK(rt_resolve_hits(scene(), hits.data(), hits.size(), 0, surfaces.data(), 0));
        size_t seen = 0;
        for (size_t i = 0; i < hits.size(); ++i) {
            ASSERT_EQ(hits[i].back_face, 0u) << "the test looks from the front only";
            ASSERT_EQ(std::memcmp(&planes.depth[i], &hits[i].t, 4), 0) << i;
            ASSERT_EQ(planes.triangles[i], hits[i].triangle) << i;
            ASSERT_EQ(std::memcmp(&planes.meshes[i], &hits[i].mesh, 8), 0) << i;
            ASSERT_EQ(std::memcmp(&planes.normals[3 * i], surfaces[i].shading_normal, 12), 0) << i;
            seen += hits[i].triangle != RT_NO_TRIANGLE;
        }
        EXPECT_TRUE(width == 1 || (seen > hits.size() / 10 && seen < hits.size()));
    }
}

TEST_F(PlanesOf, AnImageLeaveItAsItIs) {
    const rt_camera camera = world_camera();
    const Bytes expected = render(scene(), 48, 40);
    Planes planes(48, 40);
    Bytes pixels(expected.size());
    planes.frame.pixels = pixels.data();
    ASSERT_OK(rt_render_frame(scene(), &camera, &planes.frame, nullptr));
    EXPECT_EQ(pixels, expected);
    const std::vector<float> depth = planes.depth;
    planes.frame.pixels = nullptr;
    ASSERT_OK(rt_render_frame(scene(), &camera, &planes.frame, nullptr));
    EXPECT_EQ(planes.depth, depth);
}

// Each plane alone, at an odd address, with bytes between its rows that stay.
TEST_F(PlanesOf, OneKindTakeAnyStrideAndAddress) {
    constexpr uint32_t kWidth = 37, kHeight = 34;
    const rt_camera camera = world_camera();
    Planes planes(kWidth, kHeight);
    ASSERT_OK(rt_render_frame(scene(), &camera, &planes.frame, nullptr));
    const auto check = [&](const void* expected, uint32_t element, auto&& choose) {
        const uint32_t row = kWidth * element, stride = row + 5;
        Bytes loose(1 + stride * (kHeight - 1) + row, 0x5a);
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = kWidth;
        frame.height = kHeight;
        choose(frame, &loose[1], stride);
        ASSERT_OK(rt_render_frame(scene(), &camera, &frame, nullptr));
        for (uint32_t y = 0; y < kHeight; ++y) {
            EXPECT_EQ(std::memcmp(&loose[1 + y * stride],
                                  static_cast<const char*>(expected) + y * row, row),
                      0);
            for (uint32_t k = row; k < stride && y + 1 < kHeight; ++k)
                EXPECT_EQ(loose[1 + y * stride + k], 0x5a);
        }
    };
    check(planes.depth.data(), 4, [](rt_frame_desc& f, void* place, uint64_t stride) {
        f.depth = static_cast<float*>(place), f.depth_row_stride = stride;
    });
    check(planes.triangles.data(), 4, [](rt_frame_desc& f, void* place, uint64_t stride) {
        f.triangle_ids = static_cast<uint32_t*>(place), f.triangle_row_stride = stride;
    });
    check(planes.meshes.data(), 8, [](rt_frame_desc& f, void* place, uint64_t stride) {
        f.mesh_ids = static_cast<rt_mesh*>(place), f.mesh_row_stride = stride;
    });
    check(planes.normals.data(), 12, [](rt_frame_desc& f, void* place, uint64_t stride) {
        f.normals = static_cast<float*>(place), f.normal_row_stride = stride;
    });
}

} // namespace
} // namespace peregrine::test
