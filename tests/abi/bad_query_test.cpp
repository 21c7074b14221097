#include "bad_input.h"

#include <algorithm>

namespace peregrine::test {
namespace {

constexpr size_t kRays = 5;
constexpr rt_ray kGoodRay = {{0, 5, 0}, 0, {0, -1, 0}, 100};
constexpr rt_hit kUnwritten = {-7, -7, -7, 7, {7, 7}, 7, 7};

// Five good rays with canaries in front of the answers.
struct Query {
    std::vector<rt_ray> rays = std::vector<rt_ray>(kRays, kGoodRay);
    std::vector<rt_hit> hits = std::vector<rt_hit>(kRays, kUnwritten);
    std::vector<uint8_t> occluded = std::vector<uint8_t>(kRays, 7);
    rt_query_desc desc = rt_default_query_desc();

    explicit Query(rt_query_kind kind) {
        desc.kind = kind;
        desc.rays = rays.data();
        desc.ray_count = kRays;
        desc.hits = hits.data();
        desc.occluded = occluded.data();
    }

    bool unwritten() const {
        for (size_t i = 0; i < kRays; ++i)
            if (hits[i].t != -7 || hits[i].back_face != 7 || occluded[i] != 7) return false;
        return true;
    }
};

class BadQuery : public BadInput {
protected:
    void refuse(Query& query, rt_result expected, const std::string& words) {
        expect_refused(rt_trace_query(scene(), &query.desc), expected, words);
        EXPECT_TRUE(query.unwritten());
    }

    template <class Spoil>
    void refuse_both(Spoil&& spoil, rt_result expected, const std::string& words) {
        for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
            Query query(kind);
            spoil(query);
            refuse(query, expected, words);
        }
    }
};

TEST_F(BadQuery, Fields) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    refuse_both([](Query& q) { q.desc.kind = 4; }, kArgument, "rt_query_desc.kind is 4");
    refuse_both([](Query& q) { q.desc.kind = -1; }, kArgument, "rt_query_desc.kind is -1");
    refuse_both([](Query& q) { q.desc.faces = 3; }, kArgument, "rt_query_desc.faces is 3");
    refuse_both([](Query& q) { q.desc.flags = 64; }, kArgument, "rt_query_desc.flags is 0x40");
    refuse_both([](Query& q) { q.desc.coherence = 4; }, kArgument, "rt_query_desc.coherence is 4");
    refuse_both([](Query& q) { q.desc.coherence = -1; }, kArgument, "rt_query_desc.coherence");
    refuse_both([](Query& q) { q.desc.rays = nullptr; }, kArgument, "rt_query_desc.rays is null");
    refuse_both([](Query& q) { q.desc.ray_stride = 31; }, kArgument, "ray_stride is 31");
    Query closest(RT_QUERY_CLOSEST);
    closest.desc.hits = nullptr;
    refuse(closest, kArgument, "rt_query_desc.hits is null");
    Query any(RT_QUERY_ANY);
    any.desc.occluded = nullptr;
    refuse(any, kArgument, "rt_query_desc.occluded is null");
    Query overlapping(RT_QUERY_CLOSEST);
    overlapping.desc.result_stride = 16;
    refuse(overlapping, kArgument, "result_stride is 16");
    refuse_both([](Query& q) { q.desc.reserved = 1; }, kArgument, "rt_query_desc.reserved");
    Query all(RT_QUERY_ALL);
    uint32_t counts[64] = {};
    all.desc.hit_counts = counts;
    refuse(all, kArgument, "rt_query_desc.max_hits is 0");
    all.desc.max_hits = 1;
    all.desc.hit_counts = nullptr;
    refuse(all, kArgument, "rt_query_desc.hit_counts is null");
    all.desc.hit_counts = counts;
    all.desc.max_hits = 0xffffffffu;
    all.desc.ray_count = UINT64_MAX / 2;
    refuse(all, RT_ERROR_LIMIT, "rt_query_desc");
    Query count(RT_QUERY_COUNT);
    refuse(count, kArgument, "rt_query_desc.hit_counts is null");
    Query surfaces(RT_QUERY_CLOSEST);
    rt_surface surface[64];
    surfaces.desc.surfaces = surface;
    surfaces.desc.surface_fields = 1u << 6;
    refuse(surfaces, kArgument, "rt_query_desc.surface_fields is 0x40");
    surfaces.desc.surface_fields = RT_SURFACE_ALL;
    surfaces.desc.surface_stride = 8;
    refuse(surfaces, kArgument, "rt_query_desc.surface_stride is 8");
}

TEST_F(BadQuery, Counts) {
    for (const uint64_t count : {uint64_t(1) << 59, uint64_t(1) << 63, ~uint64_t(0)})
        refuse_both([&](Query& q) { q.desc.ray_count = count; }, RT_ERROR_LIMIT, "rt_query_desc");
    refuse_both(
        [](Query& q) {
            q.desc.ray_count = uint64_t(1) << 33;
            q.desc.ray_stride = 0xffffffffu;
        },
        RT_ERROR_LIMIT, "rt_query_desc.rays");
    for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
        Query none(kind);
        none.desc.ray_count = 0;
        none.desc.rays = nullptr;
        none.desc.hits = nullptr;
        none.desc.occluded = nullptr;
        EXPECT_OK(rt_trace_query(scene(), &none.desc));
    }
}

TEST_F(BadQuery, RaysAreNamed) {
    const auto with = [&](auto&& spoil, const std::string& words) {
        for (size_t i = 0; i < kRays; ++i)
            refuse_both([&](Query& q) { spoil(q.rays[i]); }, RT_ERROR_INVALID_ARGUMENT,
                        "ray " + std::to_string(i) + ": " + words);
    };
    for (int k = 0; k < 3; ++k) {
        const std::string axis(1, "xyz"[k]);
        for (const float value : {kNan, kInfinity, -kInfinity, 1.1e30f, -3e38f})
            with([&](rt_ray& r) { r.origin[k] = value; }, "origin " + axis);
        for (const float value : {kNan, kInfinity, -kInfinity})
            with([&](rt_ray& r) { r.direction[k] = value; }, "direction " + axis);
    }
    with([](rt_ray& r) { r.t_min = kNan; }, "t_min");
    with([](rt_ray& r) { r.t_max = kNan; }, "t_max");
    with([](rt_ray& r) { r.direction[1] = 0; }, "the direction is zero");
    with([](rt_ray& r) { r.direction[1] = -0.0f; }, "the direction is zero");
}

TEST_F(BadQuery, ExtremesThatAreFine) {
    Query query(RT_QUERY_CLOSEST);
    query.rays = {{{1e30f, -1e30f, 0}, -kInfinity, {3e38f, 1e-45f, 0}, kInfinity},
                  {{0, 5, 0}, 6, {0, -1, 0}, 2},
                  {{0, 5, 0}, kInfinity, {0, -1, 0}, -kInfinity},
                  {{0, 5, 0}, 0, {0, -1e-40f, 0}, kInfinity},
                  {{0, 5, 0}, 0, {0, -3e38f, 0}, kInfinity}};
    query.desc.rays = query.rays.data();
    EXPECT_OK(rt_trace_query(scene(), &query.desc));
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(query.hits[i].triangle, RT_NO_TRIANGLE) << i;
}

TEST_F(BadQuery, Resolve) {
    Query query(RT_QUERY_CLOSEST);
    ASSERT_OK(rt_trace_query(scene(), &query.desc));
    std::vector<rt_surface> surfaces(kRays);
    std::memset(surfaces.data(), 0x5a, kRays * sizeof(rt_surface));
    const std::vector<rt_surface> untouched_surfaces = surfaces;
    const auto refuse_hits = [&](const std::vector<rt_hit>& hits, rt_result expected,
                                 const std::string& words) {
        expect_refused(rt_resolve_hits(scene(), hits.data(), kRays, 0, surfaces.data(), 0),
                       expected, words);
        EXPECT_EQ(
            std::memcmp(surfaces.data(), untouched_surfaces.data(), kRays * sizeof(rt_surface)), 0);
    };
    auto hits = query.hits;
    hits[3].mesh = {99, 1};
    refuse_hits(hits, RT_ERROR_INVALID_HANDLE, "hit 3");
    hits = query.hits;
    hits[4].mesh.generation += 1;
    refuse_hits(hits, RT_ERROR_INVALID_HANDLE, "hit 4");
    hits = query.hits;
    hits[2].triangle = 1000;
    refuse_hits(hits, RT_ERROR_INVALID_ARGUMENT, "hit 2: triangle 1000");
    hits = query.hits;
    hits[1].u = kNan;
    refuse_hits(hits, RT_ERROR_INVALID_ARGUMENT, "hit 1");

    const rt_hit* good = query.hits.data();
    rt_surface* out = surfaces.data();
    const auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    expect_refused(rt_resolve_hits(scene(), nullptr, 1, 0, out, 0), kArgument, "hits is null");
    expect_refused(rt_resolve_hits(scene(), good, 1, 0, nullptr, 0), kArgument, "out_surfaces");
    expect_refused(rt_resolve_hits(scene(), good, 2, 31, out, 0), kArgument, "hit_stride is 31");
    expect_refused(rt_resolve_hits(scene(), good, 2, 0, out, 79), kArgument, "surface_stride");
    expect_refused(rt_resolve_hits(scene(), good, ~0ull, 0, out, 0), RT_ERROR_LIMIT, "hits");
    EXPECT_OK(rt_resolve_hits(scene(), nullptr, 0, 0, nullptr, 0));
}

// One ray takes a short way through the door: with the same answers and the same refusals.
TEST_F(BadQuery, ASingleRayIsTreatedAsInABatch) {
    const std::vector<rt_ray> rays = world_rays();
    std::vector<rt_hit> hits(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    rt_query_desc batch = rt_default_query_desc();
    batch.rays = rays.data();
    batch.ray_count = rays.size();
    batch.hits = hits.data();
    batch.occluded = occluded.data();
    ASSERT_OK(rt_trace_query(scene(), &batch));
    batch.kind = RT_QUERY_ANY;
    ASSERT_OK(rt_trace_query(scene(), &batch));
    for (size_t i = 0; i < rays.size(); ++i) {
        Bytes odd(1 + 32 + 32); // a ray and a hit at odd addresses
        std::memcpy(&odd[1], &rays[i], 32);
        uint8_t any = 2;
        rt_query_desc one = rt_default_query_desc();
        one.rays = reinterpret_cast<const rt_ray*>(&odd[1]);
        one.ray_count = 1;
        one.hits = reinterpret_cast<rt_hit*>(&odd[33]);
        one.occluded = &any;
        ASSERT_OK(rt_trace_query(scene(), &one));
        EXPECT_EQ(std::memcmp(&odd[33], &hits[i], 32), 0) << i;
        one.kind = RT_QUERY_ANY;
        ASSERT_OK(rt_trace_query(scene(), &one));
        EXPECT_EQ(any, occluded[i]) << i;
    }
}

TEST_F(BadQuery, ASingleRayIsRefusedAsInABatch) {
    const auto refuse_one = [&](auto&& spoil, const std::string& words) {
        refuse_both(
            [&](Query& q) {
                q.desc.ray_count = 1;
                spoil(q);
            },
            RT_ERROR_INVALID_ARGUMENT, words);
    };
    for (int k = 0; k < 3; ++k)
        for (const float value : {kNan, kInfinity, -kInfinity}) {
            refuse_one([&](Query& q) { q.rays[0].origin[k] = value; }, "ray 0: origin");
            refuse_one([&](Query& q) { q.rays[0].direction[k] = value; }, "ray 0: direction");
        }
    refuse_one([](Query& q) { q.rays[0].origin[1] = -1.1e30f; }, "ray 0: origin y");
    refuse_one([](Query& q) { q.rays[0].t_min = kNan; }, "ray 0: t_min");
    refuse_one([](Query& q) { q.rays[0].t_max = kNan; }, "ray 0: t_max");
    refuse_one([](Query& q) { q.rays[0].direction[1] = -0.0f; }, "ray 0: the direction is zero");
    refuse_one([](Query& q) { q.desc.rays = nullptr; }, "rt_query_desc.rays is null");
    refuse_one([](Query& q) { q.desc.kind = 4; }, "rt_query_desc.kind is 4");
    refuse_one([](Query& q) { q.desc.coherence = 9; }, "rt_query_desc.coherence is 9");
    refuse_one([](Query& q) { q.desc.ray_stride = 16; }, "ray_stride is 16");
    refuse_one([](Query& q) { q.desc.hits = nullptr, q.desc.occluded = nullptr; }, "is null");
}

// Records 41 bytes apart from an odd address, and not a byte between them written.
TEST_F(BadQuery, StridesAndOddAddressesAreFine) {
    constexpr uint32_t kStride = 41;
    const std::vector<rt_ray> rays = world_rays();
    const size_t count = rays.size();
    Bytes in(1 + (count - 1) * kStride + 32), out(1 + (count - 1) * kStride + 32, 0x5a);
    for (size_t i = 0; i < count; ++i) std::memcpy(&in[1 + i * kStride], &rays[i], 32);
    std::vector<rt_hit> hits(count);
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = rays.data();
    desc.ray_count = count;
    desc.hits = hits.data();
    ASSERT_OK(rt_trace_query(scene(), &desc));
    desc.rays = reinterpret_cast<const rt_ray*>(&in[1]);
    desc.hits = reinterpret_cast<rt_hit*>(&out[1]);
    desc.ray_stride = desc.result_stride = kStride;
    ASSERT_OK(rt_trace_query(scene(), &desc));
    for (size_t i = 0; i < count; ++i) {
        EXPECT_EQ(std::memcmp(&out[1 + i * kStride], &hits[i], 32), 0) << i;
        for (size_t k = 1 + i * kStride + 32; k < std::min(1 + (i + 1) * kStride, out.size()); ++k)
            EXPECT_EQ(out[k], 0x5a);
    }
}

TEST(Uncommitted, QueriesAndFramesAreRefused) {
    rt_scene scene{};
    const rt_scene_desc desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&desc, &scene));
    Query query(RT_QUERY_ANY);
    EXPECT_EQ(rt_trace_query(scene, &query.desc), RT_ERROR_NOT_COMMITTED);
    query.desc.ray_count = 1;
    EXPECT_EQ(rt_trace_query(scene, &query.desc), RT_ERROR_NOT_COMMITTED);
    EXPECT_TRUE(query.unwritten());
    rt_surface surface;
    EXPECT_EQ(rt_resolve_hits(scene, query.hits.data(), 1, 0, &surface, 0), RT_ERROR_NOT_COMMITTED);
    EXPECT_TRUE(render(scene).empty());
    EXPECT_NE(std::string(rt_get_last_error()).find("rt_commit_scene"), std::string::npos);
    EXPECT_OK(rt_destroy_scene(scene));
}

} // namespace
} // namespace peregrine::test
