// A level that lies far away gives the answers of one at (0, 0, 0), bit for bit.
#include "ask.h"
#include "bad_input.h"

namespace peregrine::test {
namespace {

//   two of these, a rigid one and a static one, 3 m apart: a square of side 2 that faces up
const std::vector<float> kSquare = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
const std::vector<uint32_t> kIndices = {0, 1, 2, 0, 2, 3};

// Everything that the queries say about a small level whose origin is at `origin`.
Bytes answers_at(const double (&origin)[3]) {
    rt_scene scene;
    const rt_scene_desc scene_desc = rt_default_scene_desc();
    EXPECT_OK(rt_create_scene(&scene_desc, &scene));
    rt_mesh_desc square = rt_default_mesh_desc();
    square.positions = array_of(kSquare, 4);
    square.indices = array_of(kIndices, 6);
    rt_mesh floor, crate;
    EXPECT_OK(rt_add_static_mesh(scene, &square, &floor));
    EXPECT_OK(rt_add_rigid_mesh(scene, &square, &crate));
    rt_transform transform = rt_default_transform();
    for (int k = 0; k < 3; ++k) transform.m[4 * k + 3] = origin[k] + (k == 0 ? 3.0 : 0.125);
    EXPECT_OK(rt_set_mesh_transform(scene, crate, &transform));
    rt_light_desc light = rt_default_light_desc();
    rt_light lamp;
    for (int k = 0; k < 3; ++k) light.position[k] = origin[k] + 2;
    EXPECT_OK(rt_add_light(scene, &light, &lamp));
    EXPECT_OK(rt_set_world_origin(scene, origin));
    EXPECT_OK(rt_commit_scene(scene, nullptr, nullptr));

    Bytes bytes;
    const auto note = [&](const void* data, size_t size) {
        const auto* first = static_cast<const unsigned char*>(data);
        bytes.insert(bytes.end(), first, first + size);
    };
    rt_query_options options = rt_default_query_options();
    std::memcpy(options.origin, origin, sizeof origin);
    for (int i = 0; i < 40; ++i) {
        const float x = -1.0f + 0.13f * float(i), z = 0.7f - 0.03f * float(i);
        rt_surface surface{};
        const rt_ray ray = {{x, 3, z}, 0, {0.01f, -1, 0.02f}, kInfinity};
        const rt_hit hit = trace_one(scene, ray, &options, &surface);
        note(&hit, offsetof(rt_hit, mesh)); // handles differ between scenes
        for (int k = 0; k < 3; ++k)
            if (hit.triangle != RT_NO_TRIANGLE) surface.position[k] -= origin[k];
        note(&surface, offsetof(rt_surface, geometric_normal));
        const rt_sweep sweep = {{x, 3, z}, 0.3f, {0.1f, 0, 0.2f}, 10, {0.01f, -1, 0.02f}, 0};
        const rt_sweep_hit contact = sweep_one(scene, sweep, &options);
        note(&contact, offsetof(rt_sweep_hit, mesh));
        const rt_nearest nearest = nearest_one(scene, {{x, 0.5f, z}, 2}, &options);
        note(&nearest, offsetof(rt_nearest, mesh));
        const rt_shape shape = {{x, 0.2f, z}, 0.25f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}};
        const bool touches = overlaps_one(scene, shape, &options);
        note(&touches, sizeof touches);
    }
    rt_camera camera = rt_default_camera();
    for (int k = 0; k < 3; ++k) camera.position[k] = origin[k] + (k == 0 ? 1.0 : 2.5);
    camera.forward[1] = -1;
    Bytes pixels(32 * 32 * 4);
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = frame.height = 32;
    EXPECT_OK(rt_render_frame(scene, &camera, &frame, nullptr));
    note(pixels.data(), pixels.size());
    EXPECT_OK(rt_destroy_scene(scene));
    return bytes;
}

TEST(FarAway, NothingChanges) {
    const Bytes near = answers_at({0, 0, 0});
    for (const double distance : {1e4, 1e5, 1e6, 1e7})
        EXPECT_EQ(answers_at({distance, -distance, 0.5 * distance}), near) << distance << " m";
}

TEST(FarAway, SingleRaysNeedNoOptions) {
    WorldGuard world;
    const double origin[3] = {100, 0, 0};
    const rt_ray ray = {{100.5f, 50, 0.25f}, 0, {0, -1, 0}, kInfinity};
    EXPECT_EQ(trace_one(world->scene, ray).triangle, RT_NO_TRIANGLE);
    ASSERT_OK(rt_set_world_origin(world->scene, origin));
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    EXPECT_NE(trace_one(world->scene, ray).triangle, RT_NO_TRIANGLE);
}

class BadOrigin : public BadInput {};

TEST_F(BadOrigin, IsRefused) {
    expect_refused(rt_set_world_origin(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT, "origin");
    for (int k = 0; k < 3; ++k)
        for (const double bad : {double(kNan), double(kInfinity), 1e31}) {
            double origin[3] = {0, 0, 0};
            origin[k] = bad;
            expect_refused(rt_set_world_origin(scene(), origin), RT_ERROR_INVALID_ARGUMENT,
                           "origin[" + std::to_string(k) + "]");
        }
    const double origin[3] = {0, 0, 0};
    expect_refused(rt_set_world_origin({}, origin), RT_ERROR_INVALID_HANDLE, "scene");
}

} // namespace
} // namespace peregrine::test
