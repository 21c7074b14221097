// Meshes that move as a whole: what is refused, and what moving means.
#include "ask.h"
#include "bad_input.h"

namespace peregrine::test {
namespace {

//   a square of side 2 around the origin, in the plane y = 0, facing up
const std::vector<float> kSquare = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
const std::vector<uint32_t> kIndices = {0, 1, 2, 0, 2, 3};

rt_mesh_desc square() {
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = array_of(kSquare, 4);
    desc.indices = array_of(kIndices, 6);
    return desc;
}

rt_transform moved(double x, double y, double z) {
    rt_transform transform = rt_default_transform();
    transform.m[3] = x;
    transform.m[7] = y;
    transform.m[11] = z;
    return transform;
}

rt_hit look_down(rt_scene scene, float x, float z) {
    const rt_ray ray = {{x, 50, z}, 0, {0, -1, 0}, kInfinity};
    return trace_one(scene, ray);
}

class BadRigidMesh : public BadInput {
protected:
    void refuse(const rt_transform& transform, const std::string& words) {
        rt_mesh mesh;
        const rt_mesh_desc desc = square();
        ASSERT_OK(rt_add_rigid_mesh(scene(), &desc, &mesh));
        EXPECT_EQ(rt_set_mesh_transform(scene(), mesh, &transform), RT_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(rt_get_last_error()).find(words), std::string::npos)
            << rt_get_last_error();
        ASSERT_OK(rt_remove_mesh(scene(), mesh));
    }
};

TEST_F(BadRigidMesh, Transforms) {
    for (int i = 0; i < 12; ++i)
        for (const double bad : {double(kNan), double(kInfinity), -1e31}) {
            rt_transform transform = rt_default_transform();
            transform.m[i] = bad;
            refuse(transform, "rt_transform.m[" + std::to_string(i) + "]");
        }
    rt_transform flat = rt_default_transform();
    flat.m[5] = 0;
    refuse(flat, "no inverse");
    flat.m[5] = 1e-10;
    refuse(flat, "no inverse");
    refuse({}, "no inverse");
}

TEST_F(BadRigidMesh, MeshesOfAnotherKind) {
    const rt_transform here = rt_default_transform();
    for (const rt_mesh mesh : {world_->ground, world_->lift}) {
        auto instance = kUntouched<rt_mesh>;
        expect_refused(rt_set_mesh_transform(scene(), mesh, &here), RT_ERROR_INVALID_ARGUMENT,
                       "is not rigid");
        expect_refused(rt_add_mesh_instance(scene(), mesh, &instance), RT_ERROR_INVALID_ARGUMENT,
                       "is not rigid");
        EXPECT_TRUE(untouched(instance));
        expect_refused(rt_set_mesh_hidden(scene(), mesh, 2), RT_ERROR_INVALID_ARGUMENT,
                       "hidden is 2");
    }
    expect_refused(rt_set_mesh_transform(scene(), {77, 1}, &here), RT_ERROR_INVALID_HANDLE, "mesh");
    expect_refused(rt_set_mesh_layer_mask(scene(), {}, 1), RT_ERROR_INVALID_HANDLE, "mesh");
    expect_refused(rt_set_mesh_hidden(scene(), {77, 1}, 1), RT_ERROR_INVALID_HANDLE, "mesh");
    auto instance = kUntouched<rt_mesh>;
    expect_refused(rt_add_mesh_instance(scene(), {77, 1}, &instance), RT_ERROR_INVALID_HANDLE,
                   "mesh");
    EXPECT_TRUE(untouched(instance));
}

class RigidMesh : public testing::Test {
protected:
    RigidMesh() {
        const rt_scene_desc desc = rt_default_scene_desc();
        EXPECT_OK(rt_create_scene(&desc, &scene_));
        const rt_mesh_desc mesh = square();
        EXPECT_OK(rt_add_rigid_mesh(scene_, &mesh, &mesh_));
    }
    ~RigidMesh() override { EXPECT_OK(rt_destroy_scene(scene_)); }

    rt_commit_report commit() {
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(scene_, nullptr, &report));
        return report;
    }
    void place(rt_mesh mesh, const rt_transform& transform) {
        EXPECT_OK(rt_set_mesh_transform(scene_, mesh, &transform));
    }
    rt_mesh add_instance() {
        rt_mesh instance{};
        EXPECT_OK(rt_add_mesh_instance(scene_, mesh_, &instance));
        return instance;
    }

    rt_scene scene_{};
    rt_mesh mesh_{};
};

TEST_F(RigidMesh, RefusesNullAndUpdates) {
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = array_of(kSquare, 4);
    EXPECT_EQ(rt_update_dynamic_mesh(scene_, mesh_, &update), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(rt_get_last_error()).find("is rigid"), std::string::npos);
    EXPECT_EQ(rt_set_mesh_transform(scene_, mesh_, nullptr), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(rt_add_mesh_instance(scene_, mesh_, nullptr), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(rt_add_rigid_mesh(scene_, nullptr, &mesh_), RT_ERROR_INVALID_ARGUMENT);
}

TEST_F(RigidMesh, StandsWhereItWasPut) {
    EXPECT_EQ(commit().static_rebuilt, 1u) << "the first commit, of nothing";
    EXPECT_EQ(look_down(scene_, 0.5f, 0).t, 50);
    place(mesh_, moved(10, 3, 0));
    EXPECT_EQ(look_down(scene_, 0.5f, 0).t, 50) << "until the commit";
    EXPECT_EQ(commit().rebuilt, 0u);
    EXPECT_EQ(look_down(scene_, 0.5f, 0).triangle, RT_NO_TRIANGLE);
    const rt_hit hit = look_down(scene_, 10.5f, 0);
    EXPECT_EQ(hit.t, 47);
    EXPECT_EQ(hit.mesh.index, mesh_.index);
    rt_surface surface;
    ASSERT_OK(rt_resolve_hits(scene_, &hit, 1, 0, &surface, 0));
    EXPECT_DOUBLE_EQ(surface.position[0], 10.5);
    EXPECT_DOUBLE_EQ(surface.position[1], 3);
    EXPECT_FLOAT_EQ(surface.geometric_normal[1], 1);
}

// Turned on its side, mirrored, stretched: the normal stays square to it and on its side.
TEST_F(RigidMesh, NormalsFollow) {
    rt_transform transform = rt_default_transform();
    transform.m[0] = -1; // mirrored
    transform.m[4] = 1;  // sheared: y rises with x
    transform.m[10] = 5; // stretched
    place(mesh_, transform);
    commit();
    const rt_hit hit = look_down(scene_, 0.25f, 2);
    ASSERT_NE(hit.triangle, RT_NO_TRIANGLE);
    EXPECT_EQ(hit.back_face, 0u);
    rt_surface surface;
    ASSERT_OK(rt_resolve_hits(scene_, &hit, 1, 0, &surface, 0));
    EXPECT_NEAR(surface.geometric_normal[0], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(surface.geometric_normal[1], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(surface.position[0], 0.25, 1e-6);
    EXPECT_NEAR(surface.position[1], -0.25, 1e-6);
}

TEST_F(RigidMesh, InstancesOutliveIt) {
    const rt_mesh instance = add_instance();
    place(instance, moved(5, 0, 0));
    rt_commit_report report = commit();
    EXPECT_EQ(report.rigid_triangle_count, 2u) << "once";
    EXPECT_EQ(report.instance_count, 2u);
    ASSERT_OK(rt_remove_mesh(scene_, mesh_));
    report = commit();
    EXPECT_EQ(report.instance_count, 1u);
    EXPECT_EQ(look_down(scene_, 0.5f, 0).triangle, RT_NO_TRIANGLE);
    EXPECT_EQ(look_down(scene_, 5.5f, 0).mesh.index, instance.index);
    ASSERT_OK(rt_set_mesh_hidden(scene_, instance, 1));
    EXPECT_EQ(commit().instance_count, 0u);
    EXPECT_EQ(look_down(scene_, 5.5f, 0).triangle, RT_NO_TRIANGLE);
}

TEST_F(RigidMesh, BeyondTheLargestCoordinateItIsLeftOut) {
    const rt_mesh instance = add_instance();
    rt_transform huge = moved(0, 0, 0);
    for (const int i : {0, 5, 10}) huge.m[i] = 1e30;
    huge.m[3] = 1e30;
    place(instance, huge);
    const rt_commit_report report = commit();
    EXPECT_EQ(report.instance_count, 1u);
    EXPECT_EQ(report.non_finite_count, 2u);
    EXPECT_EQ(look_down(scene_, 0.5f, 0).t, 50);
}

TEST_F(RigidMesh, ProgressDoesNotFall) {
    rt_mesh_desc desc = square();
    for (int i = 0; i < 4; ++i) {
        rt_mesh mesh;
        ASSERT_OK((i < 2 ? rt_add_rigid_mesh : rt_add_static_mesh)(scene_, &desc, &mesh));
    }
    struct Watcher {
        float last = 0;
        uint32_t calls = 0, cancel_at = ~0u;
        bool falls = false;
    } watcher;
    rt_commit_desc options = rt_default_commit_desc();
    options.progress_user = &watcher;
    options.progress = [](void* user, float fraction) -> int32_t {
        auto& watcher = *static_cast<Watcher*>(user);
        watcher.falls |= fraction < watcher.last || fraction > 1;
        watcher.last = fraction;
        return watcher.calls++ == watcher.cancel_at;
    };
    for (watcher.cancel_at = 0;; ++watcher.cancel_at) {
        watcher.last = 0;
        watcher.calls = 0;
        const rt_result result = rt_commit_scene(scene_, &options, nullptr);
        EXPECT_FALSE(watcher.falls);
        if (result == RT_OK) break;
        ASSERT_EQ(result, RT_ERROR_CANCELLED);
    }
    EXPECT_GT(watcher.cancel_at, 4u) << "it was cancelled at every structure";
    EXPECT_EQ(watcher.last, 1.0f);
    EXPECT_EQ(look_down(scene_, 0.5f, 0).t, 50);
}

// What a frame sees is what a query says, also of meshes that moved.
TEST_F(RigidMesh, FramesSeeItWhereQueriesDo) {
    constexpr uint32_t kSize = 40;
    const rt_mesh instance = add_instance();
    rt_transform transform = moved(1.5, 1, 0.25);
    transform.m[0] = -0.5;
    place(instance, transform);
    commit();
    rt_camera camera = rt_default_camera();
    camera.position[1] = 6;
    camera.forward[1] = -1;
    camera.forward[2] = 0;
    camera.up[1] = 0;
    camera.up[2] = -1;
    std::vector<float> depth(kSize * kSize);
    std::vector<rt_mesh> meshes(kSize * kSize);
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = frame.height = kSize;
    frame.depth = depth.data();
    frame.mesh_ids = meshes.data();
    ASSERT_OK(rt_render_frame(scene_, &camera, &frame, nullptr));
    uint32_t seen[2] = {};
    for (uint32_t i = 0; i < kSize * kSize; ++i) {
        if (!(depth[i] < kInfinity)) continue;
        const bool is_instance = meshes[i].index == instance.index;
        ++seen[is_instance];
        EXPECT_NEAR(depth[i], is_instance ? 5 : 6, 1e-5);
    }
    EXPECT_GT(seen[0], 50u);
    EXPECT_GT(seen[1], 50u);
}

} // namespace
} // namespace peregrine::test
