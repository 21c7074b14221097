// Input that is unusual and yet fine: strides, odd addresses, vertices that are not finite.
#include "bad_input.h"

namespace peregrine::test {
namespace {

rt_hit ask(rt_scene scene, const rt_ray& ray) {
    rt_hit hit{};
    rt_query_desc query = rt_default_query_desc();
    query.rays = &ray;
    query.ray_count = 1;
    query.hits = &hit;
    EXPECT_OK(rt_trace_query(scene, &query));
    return hit;
}

constexpr rt_ray kDown = {{0.25f, 5, 0.25f}, 0, {0, -1, 0}, kInfinity};

class OddMesh : public testing::Test {
protected:
    OddMesh() {
        const rt_scene_desc desc = rt_default_scene_desc();
        EXPECT_OK(rt_create_scene(&desc, &scene_));
    }
    ~OddMesh() override { EXPECT_OK(rt_destroy_scene(scene_)); }

    rt_commit_report commit() {
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(scene_, nullptr, &report));
        return report;
    }

    rt_scene scene_{};
    rt_mesh mesh_{};
};

// Records of 13 bytes that begin at an odd address; the array ends with its last element, which a
// sanitizer watches.
TEST_F(OddMesh, UnalignedAndStrided) {
    const float corners[3][3] = {{0, 1, 0}, {0, 1, 1}, {1, 1, 0}};
    const uint32_t indices[3] = {0, 1, 2};
    Bytes positions(1 + 2 * 13 + 12), places(1 + 2 * 7 + 4);
    for (size_t i = 0; i < 3; ++i) {
        std::memcpy(&positions[1 + 13 * i], corners[i], sizeof corners[i]);
        std::memcpy(&places[1 + 7 * i], &indices[i], sizeof indices[i]);
    }
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = {&positions[1], 3, 13, 0};
    desc.indices = {&places[1], 3, 7, 0};
    ASSERT_OK(rt_add_static_mesh(scene_, &desc, &mesh_));
    commit();
    EXPECT_EQ(ask(scene_, kDown).t, 4);
}

TEST_F(OddMesh, TrianglesThatAreNoneAreCountedAndTheOthersKeepTheirIndices) {
    const std::vector<float> positions = {
        0, 1, 0, 0,         1, 1, 1,     1, 0, // fine
        0, 1, 0, kNan,      1, 1, 1,     1, 0, // NaN
        0, 1, 0, 0,         1, 1, 2e30f, 1, 0, // beyond 1e30
        0, 1, 0, kInfinity, 1, 1, 1,     1, 0, // infinite
        0, 1, 0, 0,         1, 1, 0,     1, 1, // without area
        0, 2, 0, 0,         2, 1, 1,     2, 0, // fine, above
    };
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(positions, 18);
    ASSERT_OK(rt_add_static_mesh(scene_, &desc, &mesh_));
    const rt_commit_report report = commit();
    EXPECT_EQ(report.triangle_count, 2u);
    EXPECT_EQ(report.non_finite_count, 3u);
    EXPECT_EQ(report.degenerate_count, 1u);
    EXPECT_EQ(ask(scene_, kDown).triangle, 5u);
}

TEST_F(OddMesh, NothingButBadTriangles) {
    const std::vector<float> positions(9, kNan);
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(positions, 3);
    ASSERT_OK(rt_add_static_mesh(scene_, &desc, &mesh_));
    EXPECT_EQ(commit().triangle_count, 0u);
    EXPECT_EQ(ask(scene_, kDown).triangle, RT_NO_TRIANGLE);
    EXPECT_FALSE(render(scene_).empty());
}

TEST_F(OddMesh, EmptyScene) {
    EXPECT_EQ(commit().triangle_count, 0u);
    const rt_hit hit = ask(scene_, kDown);
    EXPECT_EQ(hit.t, kInfinity);
    EXPECT_EQ(hit.triangle, RT_NO_TRIANGLE);
    EXPECT_EQ(hit.mesh.generation, 0u);
    EXPECT_FALSE(render(scene_).empty());
}

TEST_F(OddMesh, NormalsThatAreNoneFallBackToTheFace) {
    const std::vector<float> positions = {0, 1, 0, 0, 1, 1, 1, 1, 0};
    const std::vector<float> normals = {kNan, 0, 0, 0, kInfinity, 0, 1e30f, 0, 0};
    const std::vector<float> tangents = {kNan, 0, 0, 1, 0, 0, 0, kNan, 1, 0, 0, kInfinity};
    const std::vector<float> texcoords = {kNan, 0, kInfinity, 1, 0, -kInfinity};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(positions, 3);
    desc.normals = array_of(normals, 3);
    desc.tangents = array_of(tangents, 3);
    desc.texcoords = array_of(texcoords, 3);
    ASSERT_OK(rt_add_static_mesh(scene_, &desc, &mesh_));
    commit();
    const rt_hit hit = ask(scene_, kDown);
    rt_surface surface;
    ASSERT_OK(rt_resolve_hits(scene_, &hit, 1, 0, &surface, 0));
    EXPECT_EQ(surface.shading_normal[1], 1);
    EXPECT_EQ(surface.texcoord[0], 0);
    EXPECT_EQ(surface.texcoord[1], 0);
    EXPECT_FALSE(render(scene_).empty());
}

// A null handle in the array means the mesh's own material; a removed one shows the default.
TEST_F(OddMesh, MaterialsOfTriangles) {
    const std::vector<float> positions = {0, 1, 0, 0, 1, 1, 1, 1, 0, 5, 1, 0, 5, 1, 1, 6, 1, 0};
    rt_material_desc material = rt_default_material_desc();
    rt_material mine{}, other{};
    material.user_data = 5;
    ASSERT_OK(rt_add_material(scene_, &material, &mine));
    material.user_data = 6;
    ASSERT_OK(rt_add_material(scene_, &material, &other));
    const std::vector<rt_material> materials = {{}, other};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(positions, 6);
    desc.materials = array_of(materials, 2);
    desc.material = mine;
    ASSERT_OK(rt_add_static_mesh(scene_, &desc, &mesh_));
    const auto user_data = [&](float x) {
        rt_ray ray = kDown;
        ray.origin[0] += x;
        const rt_hit hit = ask(scene_, ray);
        rt_surface surface{};
        EXPECT_OK(rt_resolve_hits(scene_, &hit, 1, 0, &surface, 0));
        return surface.material_user_data;
    };
    commit();
    EXPECT_EQ(user_data(0), 5u);
    EXPECT_EQ(user_data(5), 6u);
    ASSERT_OK(rt_remove_material(scene_, other));
    EXPECT_EQ(user_data(5), 6u) << "until the commit";
    EXPECT_EQ(commit().rebuilt, 1u);
    EXPECT_EQ(user_data(5), 0u);
    EXPECT_EQ(user_data(0), 5u);
}

TEST(Commit, RebuildsOnlyWhenTheGeometryChanged) {
    WorldGuard world;
    const auto rebuilt = [&] {
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(world->scene, nullptr, &report));
        return report.rebuilt;
    };
    EXPECT_EQ(rebuilt(), 0u);
    ASSERT_OK(move_lift(*world, 2));
    EXPECT_EQ(rebuilt(), 1u);
    rt_material_desc desc = rt_default_material_desc();
    ASSERT_OK(rt_update_material(world->scene, world->material, &desc));
    EXPECT_EQ(rebuilt(), 0u) << "a colour is no geometry";
    desc.double_sided = 1;
    ASSERT_OK(rt_update_material(world->scene, world->material, &desc));
    EXPECT_EQ(rebuilt(), 1u);
    const std::vector<float> normals(12, 0.5f);
    rt_mesh_update update = rt_default_mesh_update();
    update.normals = array_of(normals, 4);
    ASSERT_OK(rt_update_dynamic_mesh(world->scene, world->lift, &update));
    EXPECT_EQ(rebuilt(), 0u) << "normals are none either";
    ASSERT_OK(rt_remove_mesh(world->scene, world->lift));
    EXPECT_EQ(rebuilt(), 0u) << "a dynamic mesh has a structure of its own";
    ASSERT_OK(rt_remove_mesh(world->scene, world->ground));
    EXPECT_EQ(rebuilt(), 1u);
}

// Each structure has options of its own: the others' change nothing.
TEST(Commit, RebuildsOnlyForOptionsThatTheStructureHeeds) {
    WorldGuard world;
    rt_commit_desc desc = rt_default_commit_desc();
    uint32_t calls = 0;
    desc.progress_user = &calls;
    desc.progress = [](void* user, float) { return ++*static_cast<uint32_t*>(user), 0; };
    const auto rebuilds = [&] {
        calls = 0;
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(world->scene, &desc, &report));
        EXPECT_EQ(report.quality, desc.quality) << "as asked for";
        EXPECT_EQ(report.rebuilt, uint32_t(calls > 1)) << "the last call is the commit's own";
        return report.rebuilt != 0;
    };
    for (const rt_structure structure : {RT_STRUCTURE_KDTREE, RT_STRUCTURE_BIH, RT_STRUCTURE_BVH}) {
        SCOPED_TRACE(structure);
        desc.structure = structure;
        EXPECT_TRUE(rebuilds());
        EXPECT_FALSE(rebuilds());
        desc.empty_bonus = desc.empty_bonus == 0 ? 0.5f : 0;
        EXPECT_EQ(rebuilds(), structure == RT_STRUCTURE_KDTREE);
        EXPECT_FALSE(rebuilds());
        desc.quality = desc.quality == RT_BUILD_FAST ? RT_BUILD_BEST : RT_BUILD_FAST;
        EXPECT_EQ(rebuilds(), structure != RT_STRUCTURE_KDTREE);
        EXPECT_FALSE(rebuilds());
        desc.memory = desc.memory == RT_MEMORY_FULL ? RT_MEMORY_COMPACT : RT_MEMORY_FULL;
        EXPECT_EQ(rebuilds(), structure == RT_STRUCTURE_BVH);
        EXPECT_FALSE(rebuilds());
    }
    desc.structure = RT_STRUCTURE_AUTO; // the BVH that there is
    EXPECT_FALSE(rebuilds());
}

} // namespace
} // namespace peregrine::test
