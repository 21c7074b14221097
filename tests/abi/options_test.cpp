// What few queries ask for: all crossings, callbacks, lists of meshes, surfaces, counters, threads.
#include "ask.h"
#include "bad_input.h"

#include <cstring>
#include <limits>
#include <random>

namespace peregrine::test {
namespace {

//   a box of side 2 around the origin, its front outside
const std::vector<float> kCorners = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                     -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
const std::vector<uint32_t> kFaces = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                      3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};

// Three boxes in a row along x, at 0, 10 and 20.
class Boxes : public testing::Test {
protected:
    Boxes() {
        rt_scene_desc scene_desc = rt_default_scene_desc();
        scene_desc.worker_count = 2;
        EXPECT_OK(rt_create_scene(&scene_desc, &scene));
        rt_mesh_desc box = rt_default_mesh_desc();
        box.positions = array_of(kCorners, 8);
        box.indices = array_of(kFaces, 36);
        for (int i = 0; i < 3; ++i) {
            box.user_data = uint64_t(i) + 5;
            EXPECT_OK(rt_add_rigid_mesh(scene, &box, &boxes[i]));
            rt_transform transform = rt_default_transform();
            transform.m[3] = 10 * i;
            EXPECT_OK(rt_set_mesh_transform(scene, boxes[i], &transform));
        }
        EXPECT_OK(rt_commit_scene(scene, nullptr, nullptr));
        query.rays = &ray;
        query.ray_count = 1;
        query.hits = hits;
        query.hit_counts = &count;
        query.occluded = &occluded;
        query.max_hits = 8;
        query.options = &options;
    }
    ~Boxes() override { EXPECT_OK(rt_destroy_scene(scene)); }

    void ask(rt_query_kind kind) {
        query.kind = kind;
        ASSERT_OK(rt_trace_query(scene, &query));
    }

    rt_scene scene{};
    rt_mesh boxes[3];
    // Through the edges that the two triangles of a side share.
    rt_ray ray = {{-5, 0, 0}, 0, {1, 0, 0}, kInfinity};
    rt_hit hits[8] = {};
    uint32_t count = 0;
    uint8_t occluded = 0;
    rt_query_options options = rt_default_query_options();
    rt_query_desc query = rt_default_query_desc();
};

TEST_F(Boxes, AllCrossingsComeOnceAndInOrder) {
    ask(RT_QUERY_COUNT);
    EXPECT_EQ(count, 6u);
    ask(RT_QUERY_ALL);
    ASSERT_EQ(count, 6u);
    for (uint32_t i = 0; i < 6; ++i) {
        EXPECT_EQ(hits[i].t, float(10 * (i / 2) + 4 + 2 * (i % 2)));
        EXPECT_EQ(hits[i].back_face, i % 2);
        EXPECT_EQ(hits[i].mesh.index, boxes[i / 2].index);
    }
    query.max_hits = 3;
    ask(RT_QUERY_ALL);
    EXPECT_EQ(count, 3u);
    EXPECT_EQ(hits[2].t, 14.0f);
}

TEST_F(Boxes, ListsOfMeshesAreIgnored) {
    const rt_mesh ignored[] = {boxes[0], {99, 99}, boxes[1], {}};
    options.ignore_meshes = ignored;
    options.ignore_count = 4;
    ask(RT_QUERY_CLOSEST);
    EXPECT_EQ(hits[0].t, 24.0f);
    ask(RT_QUERY_COUNT);
    EXPECT_EQ(count, 2u);
    query.ignore_mesh = boxes[2];
    ask(RT_QUERY_ANY);
    EXPECT_EQ(occluded, 0);
}

// One ray has a way of its own through the library, two have the batch's: the answers are the same,
// whatever is asked for.
TEST_F(Boxes, OneRayIsAnsweredAsInABatch) {
    rt_snapshot held;
    ASSERT_OK(rt_hold_snapshot(scene, &held));
    const double moved[3] = {4, 0, 0};
    ASSERT_OK(rt_set_world_origin(scene, moved));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    std::mt19937 random(1);
    const auto unit = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
    uint32_t found = 0;
    for (int i = 0; i < 2000; ++i) {
        const rt_ray one = {{10 * unit(), unit(), unit()}, 0, {unit(), 0.1f * unit(), 0}, 40};
        const rt_ray two[2] = {one, one};
        rt_query_options where = rt_default_query_options();
        where.origin[0] = i % 3 * 5.0;
        where.snapshot = i % 5 == 0 ? held : rt_snapshot{};
        rt_query_desc asked = rt_default_query_desc();
        asked.options = i % 4 == 0 ? nullptr : &where;
        asked.faces = rt_faces(i % 3);
        asked.layer_mask = i % 7 == 0 ? 2 : ~0u;
        asked.ignore_mesh = i % 2 ? boxes[i % 3] : rt_mesh{};
        asked.flags = i % 11 == 0 ? RT_QUERY_ALPHA_TEST : 0;
        rt_hit alone, together[2];
        uint8_t seen_alone = 7, seen_together[2];
        asked.occluded = &seen_alone, asked.hits = &alone, asked.rays = &one, asked.ray_count = 1;
        for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
            asked.kind = kind;
            ASSERT_OK(rt_trace_query(scene, &asked));
        }
        asked.occluded = seen_together, asked.hits = together, asked.rays = two;
        asked.ray_count = 2;
        for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
            asked.kind = kind;
            ASSERT_OK(rt_trace_query(scene, &asked));
        }
        ASSERT_EQ(std::memcmp(&alone, &together[1], sizeof alone), 0) << i;
        ASSERT_EQ(seen_alone, seen_together[1]) << i;
        found += seen_alone;
    }
    EXPECT_GT(found, 200u);
    EXPECT_LT(found, 1800u);
    EXPECT_OK(rt_release_snapshot(scene, held));
}

// What is wrong with one ray's query is found on every way.
TEST_F(Boxes, OneRaysBadOptionsAreRefused) {
    const auto refused = [&](auto&& spoil) {
        options = rt_default_query_options();
        query.reserved = 0;
        spoil();
        hits[0].t = -1;
        EXPECT_NE(rt_trace_query(scene, &query), RT_OK);
        EXPECT_EQ(hits[0].t, -1.0f);
    };
    refused([&] { options.reserved = 1; });
    refused([&] { options.origin[1] = std::numeric_limits<double>::quiet_NaN(); });
    refused([&] { options.origin[2] = 1e31; });
    refused([&] { options.snapshot = {7, 7}; });
    refused([&] { options.struct_size = 3; });
    refused([&] { query.reserved = 1; });
    query.options = nullptr;
    refused([&] { query.reserved = 1; });
}

// Takes back faces of one mesh alone, and remembers for which ray it was asked.
struct Judge {
    rt_mesh mesh;
    uint64_t index = 77;
    static int32_t accept(void* user, uint64_t index, const rt_hit* hit) {
        auto* judge = static_cast<Judge*>(user);
        judge->index = index;
        return hit->mesh.index == judge->mesh.index && hit->back_face == 1;
    }
};

TEST_F(Boxes, TheHostDecidesWhatCounts) {
    Judge judge{boxes[1]};
    options.accept = Judge::accept;
    options.accept_user = &judge;
    ask(RT_QUERY_CLOSEST);
    EXPECT_EQ(hits[0].t, 16.0f);
    EXPECT_EQ(judge.index, 0u);
    ask(RT_QUERY_COUNT);
    EXPECT_EQ(count, 1u);
    judge.mesh = {99, 99};
    ask(RT_QUERY_ANY);
    EXPECT_EQ(occluded, 0);
}

// Shapes: the triangle alone is told.
struct MeshJudge {
    rt_mesh mesh;
    static int32_t accept(void* user, uint64_t, const rt_hit* hit) {
        EXPECT_EQ(hit->t, 0.0f);
        return hit->mesh.index == static_cast<MeshJudge*>(user)->mesh.index;
    }
};

TEST_F(Boxes, TheHostDecidesAboutShapesToo) {
    MeshJudge judge{boxes[2]};
    options.accept = MeshJudge::accept;
    options.accept_user = &judge;
    rt_query_stats stats = rt_default_query_stats();
    options.stats = &stats;
    const rt_sweep sweep = {{-5, 0, 0}, 0.5f, {0, 0, 0}, 100, {1, 0, 0}, 0};
    const rt_sweep_hit contact = sweep_one(scene, sweep, &options);
    EXPECT_EQ(contact.mesh.index, boxes[2].index);
    EXPECT_EQ(contact.t, 23.5f);
    EXPECT_GT(stats.triangles, 0u);
    EXPECT_GT(stats.nodes, 0u);
    EXPECT_EQ(stats.instances, 3u);

    const rt_shape shape = {{10, 0, 0}, 1.5f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}};
    EXPECT_FALSE(overlaps_one(scene, shape, &options));
    judge.mesh = boxes[1];
    EXPECT_TRUE(overlaps_one(scene, shape, &options));

    judge.mesh = boxes[0];
    EXPECT_EQ(nearest_one(scene, {{9, 0, 3}, 20}, &options).mesh.index, boxes[0].index);
    EXPECT_GT(stats.triangles, 0u);
}

// Asked for both, the flag says what the count says.
TEST_F(Boxes, OverlapsAreFlaggedCountedAndListed) {
    const rt_shape shapes[2] = {{{0, 0, 1}, 0.25f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                                {{5, 0, 0}, 0.25f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}}};
    uint8_t overlapping[2] = {7, 7};
    uint32_t counts[2] = {7, 7};
    rt_overlap overlaps[2] = {};
    rt_overlap_desc desc = rt_default_overlap_desc();
    desc.shapes = shapes;
    desc.shape_count = 2;
    desc.overlapping = overlapping;
    desc.overlap_counts = counts;
    desc.overlaps = overlaps;
    desc.max_overlaps = 1;
    ASSERT_OK(rt_overlap_shapes(scene, &desc));
    EXPECT_EQ(counts[0], 2u); // the two triangles of a side
    EXPECT_EQ(counts[1], 0u);
    EXPECT_EQ(overlapping[0], 1);
    EXPECT_EQ(overlapping[1], 0);
    EXPECT_EQ(overlaps[0].mesh.index, boxes[0].index);
    EXPECT_EQ(overlaps[0].triangle, 2u);
}

// The one rounding that the header speaks of, before static meshes (far_ships_test.cpp has rigid
// ones). GCC 12 has left it out (CMakeLists.txt).
TEST_F(Boxes, OriginsAreRoundedToFloat) {
    for (const rt_mesh& box : boxes) ASSERT_OK(rt_set_mesh_hidden(scene, box, 1));
    rt_mesh_desc box = rt_default_mesh_desc();
    box.positions = array_of(kCorners, 8);
    box.indices = array_of(kFaces, 36);
    rt_mesh fixed;
    ASSERT_OK(rt_add_static_mesh(scene, &box, &fixed));
    ASSERT_OK(rt_commit_scene(scene, nullptr, nullptr));
    for (int i = 0; i < 100; ++i) {
        const double origin[3] = {-5 + 0.1 * i, 0.0123 * i - 0.7, 2.967 - 0.0031 * i};
        float rounded[3];
        for (int k = 0; k < 3; ++k) options.origin[k] = origin[k], rounded[k] = float(origin[k]);
        rt_sweep sweep = {{0, 0, 0}, 0.3f, {0, 0.2f, 0}, 10, {0.3f, 0.1f, -1}, 0};
        const rt_sweep_hit relative = sweep_one(scene, sweep, &options);
        std::memcpy(sweep.center, rounded, sizeof rounded);
        const rt_sweep_hit absolute = sweep_one(scene, sweep);
        EXPECT_EQ(relative.t, absolute.t) << i;
        EXPECT_EQ(std::memcmp(relative.normal, absolute.normal, sizeof absolute.normal), 0) << i;

        rt_point point = {{0, 0, 0}, 20};
        const rt_nearest near = nearest_one(scene, point, &options);
        std::memcpy(point.position, rounded, sizeof rounded);
        EXPECT_EQ(near.distance, nearest_one(scene, point).distance) << i;

        rt_ray from = {{0, 0, 0}, 0, {0.3f, 0.1f, -1}, kInfinity};
        const rt_hit hit = trace_one(scene, from, &options);
        std::memcpy(from.origin, rounded, sizeof rounded);
        EXPECT_EQ(hit.t, trace_one(scene, from).t) << i;
    }
}

TEST_F(Boxes, SurfacesComeWithTheHits) {
    rt_surface surfaces[8];
    std::memset(surfaces, 0x5a, sizeof surfaces);
    query.surfaces = surfaces;
    query.surface_fields = RT_SURFACE_POSITION | RT_SURFACE_USER_DATA;
    ask(RT_QUERY_CLOSEST);
    EXPECT_EQ(surfaces[0].position[0], -1.0);
    EXPECT_EQ(surfaces[0].mesh_user_data, 5u);
    EXPECT_EQ(surfaces[0].geometric_normal[0], 0.0f) << "not asked for";
    query.surface_fields = RT_SURFACE_ALL;
    ask(RT_QUERY_ALL);
    EXPECT_EQ(surfaces[3].geometric_normal[0], 1.0f);
    EXPECT_EQ(surfaces[5].mesh_user_data, 7u);
}

TEST_F(Boxes, CountersTellTheWork) {
    rt_query_stats stats = rt_default_query_stats();
    options.stats = &stats;
    ask(RT_QUERY_COUNT);
    EXPECT_EQ(stats.instances, 3u);
    EXPECT_GE(stats.triangles, 6u);
    EXPECT_GT(stats.nodes, 0u);
}

TEST_F(Boxes, ThreadsGiveTheSameAnswers) {
    constexpr size_t kRays = 20000;
    std::vector<rt_ray> rays(kRays, ray);
    for (size_t i = 0; i < kRays; ++i) {
        rays[i].origin[1] = 1.5f - 0.00015f * float(i);
        rays[i].direction[2] = 0.00001f * float(i);
    }
    std::vector<rt_hit> alone(kRays), together(kRays);
    query.rays = rays.data();
    query.ray_count = kRays;
    query.options = nullptr;
    query.hits = alone.data();
    ask(RT_QUERY_CLOSEST);
    query.hits = together.data();
    query.flags = RT_QUERY_USE_THREADS;
    ask(RT_QUERY_CLOSEST);
    EXPECT_EQ(std::memcmp(alone.data(), together.data(), kRays * sizeof(rt_hit)), 0);

    std::vector<rt_sweep> sweeps;
    for (const rt_ray& r : rays)
        sweeps.push_back({{r.origin[0], r.origin[1], r.origin[2]},
                          0.3f,
                          {0, 0.2f, 0},
                          50,
                          {r.direction[0], r.direction[1], r.direction[2]},
                          0});
    std::vector<rt_sweep_hit> one(kRays), many(kRays);
    rt_sweep_desc desc = rt_default_sweep_desc();
    desc.sweeps = sweeps.data();
    desc.sweep_count = kRays;
    desc.hits = one.data();
    ASSERT_OK(rt_sweep_shapes(scene, &desc));
    desc.hits = many.data();
    desc.flags = RT_QUERY_USE_THREADS;
    ASSERT_OK(rt_sweep_shapes(scene, &desc));
    EXPECT_EQ(std::memcmp(one.data(), many.data(), kRays * sizeof(rt_sweep_hit)), 0);
}

} // namespace
} // namespace peregrine::test
