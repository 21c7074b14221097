// Ends that are infinite, negative or out of reach, hits of worlds that are gone, and what can be
// said of a mesh after it was added.
#include "ask.h"
#include "bad_input.h"

#include <array>
#include <limits>

namespace peregrine::test {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

rt_mesh add_square(rt_scene scene, double height, uint64_t user_data) {
    const std::vector<float> corners = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
    const std::vector<uint32_t> faces = {0, 1, 2, 0, 2, 3};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = array_of(corners, 4);
    desc.indices = array_of(faces, 6);
    desc.user_data = user_data;
    rt_mesh mesh{};
    EXPECT_OK(rt_add_rigid_mesh(scene, &desc, &mesh));
    rt_transform transform = rt_default_transform();
    transform.m[7] = height;
    EXPECT_OK(rt_set_mesh_transform(scene, mesh, &transform));
    return mesh;
}

// Squares in a pile, at heights 0, 1, 2, ...
class Pile : public testing::TestWithParam<rt_structure> {
protected:
    explicit Pile(int count = 3) {
        const rt_scene_desc desc = rt_default_scene_desc();
        EXPECT_OK(rt_create_scene(&desc, &scene));
        for (int i = 0; i < count; ++i) squares.push_back(add_square(scene, i, uint64_t(i) + 10));
        commit();
    }
    ~Pile() override { EXPECT_OK(rt_destroy_scene(scene)); }

    void commit() { EXPECT_OK(rt_commit_scene(scene, nullptr, nullptr)); }

    rt_scene scene{};
    std::vector<rt_mesh> squares;
};

TEST_F(Pile, ANearestPointIsSoughtWithoutEnd) {
    for (const float radius : {5.0f, 1e30f, 2e30f, kLargest, kInfinity}) {
        const rt_nearest found = nearest_one(scene, {{0.2f, 5, 0.3f}, radius});
        EXPECT_EQ(found.distance, 3) << radius;
        EXPECT_EQ(found.mesh.index, squares[2].index);
        EXPECT_EQ(found.point[1], 2);
    }
    EXPECT_EQ(nearest_one(scene, {{1e30f, 1e30f, 0}, kInfinity}).mesh.index, squares[0].index);
    for (const float radius : {-1.0f, -1e-45f, -kInfinity}) {
        const rt_nearest none = nearest_one(scene, {{0, 0, 0}, radius});
        EXPECT_EQ(none.distance, kInfinity);
        EXPECT_EQ(none.triangle, RT_NO_TRIANGLE);
    }
    EXPECT_EQ(nearest_one(scene, {{0, 0, 0}, -0.0f}).distance, 0);
}

TEST_F(Pile, ASweepOverAnEmptyWayTouchesNothing) {
    const auto sweep = [&](float height, float t_max) {
        return sweep_one(scene, {{0, height, 0}, 0.25f, {0, 0, 0}, t_max, {0, -1, 0}, 0});
    };
    for (const float t_max : {10.0f, kLargest, kInfinity}) EXPECT_EQ(sweep(5, t_max).t, 2.75f);
    EXPECT_EQ(sweep(2, 0).t, 0);
    EXPECT_EQ(sweep(2, -0.0f).t, 0);
    for (const float t_max : {-1e-45f, -1.0f, -kLargest, -kInfinity})
        for (const float height : {2.0f, 5.0f}) {
            const rt_sweep_hit none = sweep(height, t_max);
            EXPECT_EQ(none.t, kInfinity);
            EXPECT_EQ(none.triangle, RT_NO_TRIANGLE);
            EXPECT_EQ(none.initial_contact, 0u);
        }
}

// t = 4e38 is no float: nothing finds what lies there, whatever it is asked.
TEST_F(Pile, WhatNoFloatCanNameIsOutOfReach) {
    rt_hit hits[8];
    uint8_t occluded[8];
    uint32_t counts[8];
    for (const float height : {7.0f, 2.25f}) {
        const bool reached = height < 3;
        for (const uint64_t count : {1u, 2u, 8u})
            for (const float up : {1.0f, -1.0f}) {
                // Backwards, t is -4e38, which is no float either.
                const rt_ray ray =
                    up > 0 ? rt_ray{{0.1f, height, 0.2f}, 0, {0, -1e-38f, 0}, kInfinity}
                           : rt_ray{{0.1f, height, 0.2f}, -kInfinity, {0, 1e-38f, 0}, 0};
                const std::vector<rt_ray> rays(count, ray);
                rt_query_desc desc = rt_default_query_desc();
                desc.rays = rays.data();
                desc.ray_count = count;
                desc.hits = hits;
                desc.occluded = occluded;
                desc.hit_counts = counts;
                for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY, RT_QUERY_COUNT}) {
                    desc.kind = kind;
                    ASSERT_OK(rt_trace_query(scene, &desc));
                }
                for (uint64_t i = 0; i < count; ++i) {
                    EXPECT_EQ(hits[i].triangle != RT_NO_TRIANGLE, reached);
                    EXPECT_EQ(std::isfinite(hits[i].t), reached);
                    EXPECT_EQ(occluded[i], reached);
                    EXPECT_EQ(counts[i] > 0, reached);
                }
            }
        const rt_sweep_hit hit =
            sweep_one(scene, {{0, height, 0}, 0.125f, {0, 0, 0}, kInfinity, {0, -1e-38f, 0}, 0});
        EXPECT_EQ(hit.triangle != RT_NO_TRIANGLE, reached);
        EXPECT_EQ(std::isfinite(hit.t), reached);
    }
}

TEST(OddEdge, NoDistanceIsInfinite) {
    rt_scene scene{};
    const rt_scene_desc desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&desc, &scene));
    const rt_mesh square = add_square(scene, 0, 0);
    rt_transform transform = rt_default_transform();
    for (const int k : {0, 5, 10}) transform.m[k] = 1e25;
    for (const int k : {3, 7, 11}) transform.m[k] = 9e29;
    ASSERT_OK(rt_set_mesh_transform(scene, square, &transform));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    const rt_nearest near = nearest_one(scene, {{9e29f, 9e29f, 9e29f}, kInfinity});
    EXPECT_LT(near.distance, 1e26f);
    const rt_nearest far = nearest_one(scene, {{-1e30f, -1e30f, -1e30f}, kInfinity});
    EXPECT_EQ(far.mesh.index, square.index);
    EXPECT_TRUE(std::isfinite(far.distance));
    ASSERT_OK(rt_destroy_scene(scene));
}

class TallPile : public Pile {
protected:
    TallPile() : Pile(150) {}
};

TEST_F(TallPile, AllCrossingsAreCountedBeyondThoseStored) {
    const rt_ray rays[2] = {{{0.1f, 200, 0.2f}, 0, {0, -1, 0}, kInfinity},
                            {{5, 200, 0}, 0, {0, -1, 0}, kInfinity}};
    std::vector<rt_hit> hits(2 * 200);
    for (const uint32_t most : {1u, 2u, 63u, 64u, 65u, 149u, 150u, 200u}) {
        uint32_t stored[2] = {7, 7}, total[2] = {7, 7};
        rt_query_desc desc = rt_default_query_desc();
        desc.kind = RT_QUERY_ALL;
        desc.rays = rays;
        desc.ray_count = 2;
        desc.max_hits = most;
        desc.hits = hits.data();
        desc.hit_counts = stored;
        for (uint32_t* const totals : {static_cast<uint32_t*>(nullptr), total}) {
            desc.total_counts = totals;
            std::memset(hits.data(), 0x5a, hits.size() * sizeof(rt_hit));
            ASSERT_OK(rt_trace_query(scene, &desc));
            EXPECT_EQ(stored[0], std::min(most, 150u));
            EXPECT_EQ(stored[1], 0u);
            for (uint32_t i = 0; i < stored[0]; ++i) EXPECT_EQ(hits[i].t, float(51 + i));
            for (size_t i = stored[0]; i < hits.size(); ++i)
                ASSERT_EQ(hits[i].triangle, 0x5a5a5a5au);
        }
        EXPECT_EQ(total[0], 150u);
        EXPECT_EQ(total[1], 0u);
        desc.struct_size = 128; // a client of before
        total[0] = 7;
        ASSERT_OK(rt_trace_query(scene, &desc));
        EXPECT_EQ(total[0], 7u);
    }
}

TEST_F(Pile, HitsOfAHeldSnapshotAreResolvedInIt) {
    rt_snapshot held{};
    ASSERT_OK(rt_hold_snapshot(scene, &held));
    const rt_hit hit = trace_one(scene, {{0.5f, 9, 0.25f}, 0, {0, -1, 0}, kInfinity});
    ASSERT_EQ(hit.mesh.index, squares[2].index);
    ASSERT_OK(rt_remove_mesh(scene, squares[2]));
    commit();
    rt_resolve_desc desc = rt_default_resolve_desc();
    rt_surface surface{};
    desc.hits = &hit;
    desc.hit_count = 1;
    desc.surfaces = &surface;
    EXPECT_EQ(rt_resolve_surfaces(scene, &desc), RT_ERROR_INVALID_HANDLE);
    desc.snapshot = held;
    ASSERT_OK(rt_resolve_surfaces(scene, &desc));
    EXPECT_EQ(surface.position[0], 0.5);
    EXPECT_EQ(surface.position[1], 2.0);
    EXPECT_EQ(surface.mesh_user_data, 12u);
    EXPECT_EQ(surface.geometric_normal[1], 1.0f);

    desc.origin[0] = 1e9 + 0.5;
    desc.surface_fields = RT_SURFACE_POSITION;
    ASSERT_OK(rt_resolve_surfaces(scene, &desc));
    EXPECT_EQ(surface.position[0], -1e9);
    EXPECT_EQ(surface.mesh_user_data, 0u);
    EXPECT_EQ(surface.geometric_normal[1], 0.0f);

    ASSERT_OK(rt_release_snapshot(scene, held));
    EXPECT_EQ(rt_resolve_surfaces(scene, &desc), RT_ERROR_INVALID_HANDLE);
}

class BadResolve : public BadInput {};

TEST_F(BadResolve, Descriptions) {
    const rt_hit hit = trace_one(scene(), {{0.5f, 9, 0.25f}, 0, {0, -1, 0}, kInfinity});
    rt_surface surface{};
    rt_resolve_desc good = rt_default_resolve_desc();
    good.hits = &hit;
    good.hit_count = 1;
    good.surfaces = &surface;
    const auto refuse = [&](auto&& spoil, rt_result result, const std::string& words) {
        rt_resolve_desc desc = good;
        spoil(desc);
        expect_refused(rt_resolve_surfaces(scene(), &desc), result, words);
    };
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using Desc = rt_resolve_desc;
    refuse([](Desc& d) { d.flags = 1; }, kArgument, "rt_resolve_desc.flags");
    refuse([](Desc& d) { d.surface_fields = 64; }, kArgument, "rt_resolve_desc.surface_fields");
    refuse([](Desc& d) { d.reserved = 1; }, kArgument, "rt_resolve_desc.reserved");
    refuse([](Desc& d) { d.origin[2] = 2e30; }, kArgument, "rt_resolve_desc.origin[2]");
    refuse([](Desc& d) { d.hits = nullptr; }, kArgument, "rt_resolve_desc.hits");
    refuse([](Desc& d) { d.surfaces = nullptr; }, kArgument, "rt_resolve_desc.surfaces");
    refuse([](Desc& d) { d.hit_stride = 31; }, kArgument, "rt_resolve_desc.hit_stride");
    refuse([](Desc& d) { d.surface_stride = 79; }, kArgument, "rt_resolve_desc.surface_stride");
    refuse([](Desc& d) { d.hit_count = ~0ull; }, RT_ERROR_LIMIT, "rt_resolve_desc.hits");
    refuse([](Desc& d) { d.struct_size = 4; }, RT_ERROR_INVALID_STRUCT, "rt_resolve_desc");
    refuse([](Desc& d) { d.snapshot = {3, 9}; }, RT_ERROR_INVALID_HANDLE, "rt_snapshot");
    expect_refused(rt_resolve_surfaces(scene(), nullptr), kArgument, "rt_resolve_desc");
    expect_refused(rt_resolve_surfaces({}, &good), RT_ERROR_INVALID_HANDLE, "scene");
    good.hit_count = 0;
    good.hits = nullptr;
    EXPECT_OK(rt_resolve_surfaces(scene(), &good));
}

TEST_F(Pile, UserDataOfAMeshCanChange) {
    rt_mesh instance{};
    ASSERT_OK(rt_add_mesh_instance(scene, squares[2], &instance));
    rt_transform transform = rt_default_transform();
    transform.m[7] = 7;
    ASSERT_OK(rt_set_mesh_transform(scene, instance, &transform));
    commit();
    const auto user_data = [&](float from) {
        rt_surface surface{};
        trace_one(scene, {{0, from, 0}, 0, {0, -1, 0}, kInfinity}, nullptr, &surface);
        return surface.mesh_user_data;
    };
    EXPECT_EQ(user_data(9), 12u);
    ASSERT_OK(rt_set_mesh_user_data(scene, instance, 77));
    EXPECT_EQ(user_data(9), 12u); // until the next commit
    commit();
    EXPECT_EQ(user_data(9), 77u);
    EXPECT_EQ(user_data(5), 12u);
    ASSERT_OK(rt_set_mesh_user_data(scene, squares[2], ~0ull));
    commit();
    EXPECT_EQ(user_data(9), 77u);
    EXPECT_EQ(user_data(5), ~0ull);
    ASSERT_OK(rt_remove_mesh(scene, instance));
    EXPECT_EQ(rt_set_mesh_user_data(scene, instance, 1), RT_ERROR_INVALID_HANDLE);
    EXPECT_EQ(rt_set_mesh_user_data({}, instance, 1), RT_ERROR_INVALID_HANDLE);
}

TEST(OddEdge, UserDataOfEveryKindOfMesh) {
    WorldGuard world;
    const rt_ray rays[2] = {{{0.1f, 9, 0.1f}, 0, {0, -1, 0}, kInfinity},
                            {{3.1f, 9, 3.1f}, 0, {0, -1, 0}, kInfinity}};
    ASSERT_OK(rt_set_mesh_user_data(world->scene, world->lift, 1001));
    ASSERT_OK(rt_set_mesh_user_data(world->scene, world->ground, 1002));
    rt_commit_report report = rt_default_commit_report();
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, &report));
    EXPECT_EQ(report.rebuilt, 0u);
    for (uint64_t i = 0; i < 2; ++i) {
        rt_surface surface{};
        trace_one(world->scene, rays[i], nullptr, &surface);
        EXPECT_EQ(surface.mesh_user_data, 1001 + i);
    }
}

// The same rays with ends of all sorts, against what the numbers say.
TEST_P(Pile, EndsOfRaysMayBeInfinite) {
    rt_commit_desc commit_desc = rt_default_commit_desc();
    commit_desc.structure = GetParam();
    const std::vector<float> corners = {-1, 4, 1, 1, 4, 1, 1, 4, -1};
    rt_mesh_desc mesh_desc = rt_default_mesh_desc();
    mesh_desc.index_type = RT_INDEX_NONE;
    mesh_desc.positions = array_of(corners, 3);
    rt_mesh fixed{};
    ASSERT_OK(rt_add_static_mesh(scene, &mesh_desc, &fixed));
    ASSERT_OK(rt_commit_scene(scene, &commit_desc, nullptr));
    const float ends[] = {-kInfinity, -kLargest, -3.5f, -0.0f, 0, 1.5f, 2, kLargest, kInfinity};
    for (const rt_coherence hint : {RT_COHERENCE_AUTO, RT_COHERENCE_COHERENT,
                                    RT_COHERENCE_COMMON_ORIGIN, RT_COHERENCE_INCOHERENT})
        for (const size_t copies : {1u, 40u}) {
            std::vector<rt_ray> rays;
            for (const float begin : ends)
                for (const float end : ends)
                    for (size_t i = 0; i < copies; ++i)
                        rays.push_back({{0.5f, 2.5f, 0.25f}, begin, {0, -1, 0}, end});
            std::vector<rt_hit> hits(rays.size());
            std::vector<uint8_t> occluded(rays.size());
            std::vector<uint32_t> counts(rays.size());
            rt_query_desc desc = rt_default_query_desc();
            desc.rays = rays.data();
            desc.ray_count = rays.size();
            desc.hits = hits.data();
            desc.occluded = occluded.data();
            desc.hit_counts = counts.data();
            desc.coherence = hint;
            for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY, RT_QUERY_COUNT}) {
                desc.kind = kind;
                ASSERT_OK(rt_trace_query(scene, &desc));
            }
            for (size_t i = 0; i < rays.size(); ++i) {
                float first = kInfinity;
                uint32_t count = 0;
                for (const float t : {-1.5f, 0.5f, 1.5f, 2.5f}) {
                    if (!(t >= rays[i].t_min && t <= rays[i].t_max)) continue;
                    first = std::min(first, t);
                    ++count;
                }
                ASSERT_EQ(hits[i].t, first) << rays[i].t_min << " to " << rays[i].t_max;
                ASSERT_EQ(occluded[i], count > 0) << rays[i].t_min << " to " << rays[i].t_max;
                ASSERT_EQ(counts[i], count) << rays[i].t_min << " to " << rays[i].t_max;
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Structures, Pile,
                         testing::Values(RT_STRUCTURE_BVH, RT_STRUCTURE_KDTREE, RT_STRUCTURE_BIH));

} // namespace
} // namespace peregrine::test
