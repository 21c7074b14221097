// RT_QUERY_MARK_INVALID: records that are not valid are marked, the others are answered as if they
// were alone.
#include "bad_input.h"
#include "ray_batch.h"

#include <cmath>

namespace peregrine::test {
namespace {

class MarkInvalid : public BadInput {};

bool same(const rt_hit& a, const rt_hit& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

bool is_marked(const rt_hit& hit) {
    return std::isnan(hit.t) && std::isnan(hit.u) && std::isnan(hit.v)
           && hit.triangle == RT_NO_TRIANGLE && hit.mesh.index == 0 && hit.mesh.generation == 0
           && hit.instance == 0 && hit.back_face == 0;
}

bool is_marked(const rt_surface& surface) {
    rt_surface rest = surface;
    for (double& x : rest.position) {
        if (!std::isnan(x)) return false;
        x = 0;
    }
    const rt_surface zero{};
    return std::memcmp(&rest, &zero, sizeof rest) == 0;
}

// Rays on the world, every seventh spoilt, each in a way of its own.
struct SpoiltRays {
    std::vector<rt_ray> good, rays;

    explicit SpoiltRays(size_t count) {
        const std::vector<rt_ray> some = world_rays();
        for (size_t i = 0; i < count; ++i) good.push_back(some[i * 37 % some.size()]);
        rays = good;
        for (size_t i = 0; i < count; i += 7) {
            rt_ray& ray = rays[i];
            switch (i / 7 % 6) {
            case 0:
                ray.origin[i % 3] = kNan;
                break;
            case 1:
                ray.direction[i % 3] = kInfinity;
                break;
            case 2:
                ray.direction[0] = ray.direction[1] = ray.direction[2] = 0;
                break;
            case 3:
                ray.t_max = kNan;
                break;
            case 4:
                ray.origin[1] = -2e30f;
                break;
            default:
                ray.t_min = kNan;
            }
        }
    }
    bool is_bad(size_t i) const { return i % 7 == 0; }
};

struct RayAnswers {
    std::vector<rt_hit> closest, all;
    std::vector<rt_surface> surfaces;
    std::vector<uint8_t> occluded;
    std::vector<uint32_t> stored, totals, counts;

    explicit RayAnswers(size_t n)
        : closest(n), all(2 * n), surfaces(n), occluded(n), stored(n), totals(n), counts(n) {
        std::memset(all.data(), 0x5a, all.size() * sizeof all[0]);
    }

    void ask(rt_scene scene, rt_query_desc desc) {
        const auto next = [&](rt_query_kind kind) {
            desc.kind = kind;
            EXPECT_OK(rt_trace_query(scene, &desc));
        };
        desc.hits = closest.data();
        desc.surfaces = surfaces.data();
        desc.surface_fields = RT_SURFACE_ALL & ~RT_SURFACE_POSITION;
        next(RT_QUERY_CLOSEST);
        desc.surfaces = nullptr;
        desc.occluded = occluded.data();
        next(RT_QUERY_ANY);
        desc.hits = all.data();
        desc.max_hits = 2;
        desc.hit_counts = stored.data();
        desc.total_counts = totals.data();
        next(RT_QUERY_ALL);
        desc.hit_counts = counts.data();
        next(RT_QUERY_COUNT);
    }

    void expect_marked(size_t i) const {
        EXPECT_TRUE(is_marked(closest[i])) << i;
        EXPECT_TRUE(is_marked(surfaces[i])) << i;
        EXPECT_EQ(occluded[i], RT_INVALID_BYTE) << i;
        EXPECT_EQ(stored[i], RT_INVALID_COUNT) << i;
        EXPECT_EQ(totals[i], RT_INVALID_COUNT) << i;
        EXPECT_EQ(counts[i], RT_INVALID_COUNT) << i;
        EXPECT_EQ(all[2 * i].triangle, 0x5a5a5a5au) << i;
    }

    void expect_same(size_t i, const RayAnswers& other) const {
        EXPECT_TRUE(same(closest[i], other.closest[i])) << i;
        EXPECT_EQ(std::memcmp(&surfaces[i], &other.surfaces[i], sizeof surfaces[i]), 0) << i;
        EXPECT_EQ(occluded[i], other.occluded[i]) << i;
        EXPECT_EQ(stored[i], other.stored[i]) << i;
        EXPECT_EQ(totals[i], other.totals[i]) << i;
        EXPECT_EQ(counts[i], other.counts[i]) << i;
        for (size_t k = 2 * i; k < 2 * i + std::min(stored[i], 2u); ++k)
            EXPECT_TRUE(same(all[k], other.all[k])) << i;
    }
};

int32_t takes_all(void*, uint64_t index, const rt_hit* hit) {
    EXPECT_NE(index % 7, 0u);
    EXPECT_FALSE(std::isnan(hit->t));
    return 1;
}

TEST_F(MarkInvalid, Rays) {
    for (const size_t count : {1u, 2u, 7u, 8u, 20u, 1024u, 1025u, 2100u, 9000u}) {
        const SpoiltRays spoilt(count);
        RayBatch arrays(spoilt.rays, count % 2 ? 4 : 0);
        rt_query_stats stats = rt_default_query_stats();
        for (int way = 0; way < 12; ++way) {
            rt_query_options options = rt_default_query_options();
            if (way & 1) options.origin[0] = 0.25;
            if (way / 4 == 1) options.accept = takes_all;
            if (way / 4 == 2) options.stats = &stats;
            rt_query_desc desc = rt_default_query_desc();
            desc.options = &options;
            desc.flags = way / 4 == 2 ? uint32_t(RT_QUERY_USE_THREADS) : 0u;
            desc.ray_count = count;
            RayAnswers expected(count), got(count);
            desc.rays = spoilt.good.data();
            if (way / 4 != 1) expected.ask(scene(), desc);
            desc.flags |= RT_QUERY_MARK_INVALID;
            desc.rays = way & 2 ? nullptr : spoilt.rays.data();
            desc.ray_arrays = way & 2 ? &arrays.arrays : nullptr;
            got.ask(scene(), desc);
            for (size_t i = 0; i < count; ++i)
                if (spoilt.is_bad(i))
                    got.expect_marked(i);
                else if (way / 4 != 1)
                    got.expect_same(i, expected);
            if (HasFailure()) FAIL() << count << " rays, way " << way;
        }
    }
}

TEST_F(MarkInvalid, HitArrays) {
    for (const size_t count : {1u, 20u, 1040u, 5000u})
        for (const size_t offset : {0u, 4u}) {
            const SpoiltRays spoilt(count);
            const RayBatch in(spoilt.rays, offset);
            HitBatch out(count, offset), expected(count, offset);
            rt_query_desc desc = rt_default_query_desc();
            desc.ray_count = count;
            desc.rays = spoilt.good.data();
            desc.hit_arrays = &expected.arrays;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            desc.rays = nullptr;
            desc.ray_arrays = &in.arrays;
            desc.hit_arrays = &out.arrays;
            desc.flags = RT_QUERY_MARK_INVALID;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            for (size_t i = 0; i < count; ++i)
                EXPECT_TRUE(spoilt.is_bad(i) ? is_marked(out.hit(i))
                                             : same(out.hit(i), expected.hit(i)))
                    << i;
        }
}

// Batches that are wholly good, and what is wrong with a call beside its records.
TEST_F(MarkInvalid, NothingElseChanges) {
    SpoiltRays spoilt(40);
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = spoilt.good.data();
    desc.ray_count = 40;
    std::vector<rt_hit> hits(40), expected(40);
    desc.hits = expected.data();
    ASSERT_OK(rt_trace_query(scene(), &desc));
    desc.flags = RT_QUERY_MARK_INVALID;
    desc.hits = hits.data();
    ASSERT_OK(rt_trace_query(scene(), &desc));
    EXPECT_EQ(bytes_of(hits), bytes_of(expected));
    desc.ray_stride = 31;
    expect_refused(rt_trace_query(scene(), &desc), RT_ERROR_INVALID_ARGUMENT, "ray_stride");
    desc.ray_stride = 0;
    desc.flags = 0;
    desc.rays = spoilt.rays.data();
    expect_refused(rt_trace_query(scene(), &desc), RT_ERROR_INVALID_ARGUMENT, "ray 0: ");
}

TEST_F(MarkInvalid, Sweeps) {
    const rt_sweep good = {{0.1f, 9, 0.2f}, 0.5f, {0, 0.5f, 0}, 20, {0, -1, 0}, 0};
    std::vector<rt_sweep> sweeps(6000, good);
    for (size_t i = 0; i < sweeps.size(); i += 5) {
        rt_sweep& sweep = sweeps[i];
        switch (i / 5 % 6) {
        case 0:
            sweep.center[0] = kNan;
            break;
        case 1:
            sweep.radius = -1;
            break;
        case 2:
            sweep.axis[2] = kInfinity;
            break;
        case 3:
            sweep.t_max = kNan;
            break;
        case 4:
            sweep.direction[1] = 0;
            break;
        default:
            sweep.reserved = 1;
        }
    }
    std::vector<rt_sweep_hit> hits(sweeps.size());
    rt_sweep_hit expected;
    rt_sweep_desc desc = rt_default_sweep_desc();
    desc.sweeps = &good;
    desc.sweep_count = 1;
    desc.hits = &expected;
    ASSERT_OK(rt_sweep_shapes(scene(), &desc));
    ASSERT_TRUE(std::isfinite(expected.t));
    desc.sweeps = sweeps.data();
    desc.sweep_count = sweeps.size();
    desc.hits = hits.data();
    expect_refused(rt_sweep_shapes(scene(), &desc), RT_ERROR_INVALID_ARGUMENT, "sweep 0");
    for (const uint32_t flags : {0u, uint32_t(RT_QUERY_USE_THREADS)}) {
        desc.flags = flags | RT_QUERY_MARK_INVALID;
        std::memset(hits.data(), 0x5a, hits.size() * sizeof hits[0]);
        ASSERT_OK(rt_sweep_shapes(scene(), &desc));
        rt_sweep_hit marked{};
        marked.triangle = RT_NO_TRIANGLE;
        for (size_t i = 0; i < hits.size(); ++i) {
            if (i % 5 == 0) {
                EXPECT_TRUE(std::isnan(hits[i].t)) << i;
                hits[i].t = 0;
            }
            EXPECT_EQ(std::memcmp(&hits[i], i % 5 ? &expected : &marked, sizeof marked), 0) << i;
        }
    }
}

TEST_F(MarkInvalid, Overlaps) {
    rt_shape shapes[6] = {{{0, 1, 0}, 0.5f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                          {{0, 1, kNan}, 0.5f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                          {{0, 1, 0}, 0.5f, {1, 1, 1}, RT_SHAPE_BOX, {0, 0, 0, 0}},
                          {{0, 1, 0}, 0.5f, {1, -1, 1}, RT_SHAPE_BOX, {0, 0, 0, 1}},
                          {{0, 1, 0}, 0.5f, {1, 1, 1}, 3, {0, 0, 0, 1}},
                          {{0, 90, 0}, 0.5f, {0, 1, 0}, RT_SHAPE_CAPSULE, {0, 0, 0, 0}}};
    const uint8_t expected[6] = {
        1, RT_INVALID_BYTE, RT_INVALID_BYTE, RT_INVALID_BYTE, RT_INVALID_BYTE, 0};
    for (const bool counted : {false, true}) {
        uint8_t overlapping[6] = {};
        uint32_t counts[6] = {};
        rt_overlap touched[12];
        std::memset(touched, 0x5a, sizeof touched);
        rt_overlap_desc desc = rt_default_overlap_desc();
        desc.shapes = shapes;
        desc.shape_count = 6;
        desc.overlapping = overlapping;
        if (counted) {
            desc.overlap_counts = counts;
            desc.overlaps = touched;
            desc.max_overlaps = 2;
        }
        expect_refused(rt_overlap_shapes(scene(), &desc), RT_ERROR_INVALID_ARGUMENT, "shape 1");
        desc.flags = RT_QUERY_MARK_INVALID;
        ASSERT_OK(rt_overlap_shapes(scene(), &desc));
        for (size_t i = 0; i < 6; ++i) {
            EXPECT_EQ(overlapping[i], expected[i]) << i;
            if (!counted) continue;
            EXPECT_EQ(counts[i] == RT_INVALID_COUNT, expected[i] == RT_INVALID_BYTE) << i;
            EXPECT_EQ(touched[2 * i].triangle == 0x5a5a5a5au, expected[i] != 1) << i;
        }
    }
}

TEST_F(MarkInvalid, Points) {
    const rt_point points[4] = {
        {{0, 1.5f, 0}, 5}, {{0, kInfinity, 0}, 5}, {{0, 1.5f, 0}, kNan}, {{0, 90, 0}, 5}};
    rt_nearest results[4];
    rt_nearest_desc desc = rt_default_nearest_desc();
    desc.points = points;
    desc.point_count = 4;
    desc.results = results;
    expect_refused(rt_find_nearest(scene(), &desc), RT_ERROR_INVALID_ARGUMENT, "point 1");
    rt_query_options options = rt_default_query_options();
    desc.flags = RT_QUERY_MARK_INVALID;
    for (const double x : {0.0, 0.5}) {
        options.origin[0] = x;
        desc.options = &options;
        ASSERT_OK(rt_find_nearest(scene(), &desc));
        EXPECT_EQ(results[0].distance, 0.5f);
        for (const size_t i : {1u, 2u}) {
            EXPECT_TRUE(std::isnan(results[i].distance));
            EXPECT_EQ(results[i].triangle, RT_NO_TRIANGLE);
            EXPECT_EQ(results[i].mesh.generation, 0u);
        }
        EXPECT_EQ(results[3].distance, kInfinity);
    }
}

TEST_F(MarkInvalid, Hits) {
    const std::vector<rt_ray> rays = world_rays();
    std::vector<rt_hit> hits(rays.size());
    rt_query_desc query = rt_default_query_desc();
    query.rays = rays.data();
    query.ray_count = rays.size();
    query.hits = hits.data();
    ASSERT_OK(rt_trace_query(scene(), &query));
    std::vector<rt_surface> expected(hits.size()), surfaces(hits.size());
    ASSERT_OK(rt_resolve_hits(scene(), hits.data(), hits.size(), 0, expected.data(), 0));
    for (size_t i = 0; i < hits.size(); i += 3) {
        rt_hit& hit = hits[i];
        hit.mesh = world_->ground;
        hit.triangle = 3;
        switch (i / 3 % 4) {
        case 0:
            hit.mesh.generation += 1;
            break;
        case 1:
            hit.mesh.index = 99;
            break;
        case 2:
            hit.triangle = 1000;
            break;
        default:
            hit.v = kNan;
        }
    }
    rt_resolve_desc desc = rt_default_resolve_desc();
    desc.hits = hits.data();
    desc.hit_count = hits.size();
    desc.surfaces = surfaces.data();
    expect_refused(rt_resolve_surfaces(scene(), &desc), RT_ERROR_INVALID_HANDLE, "hit 0");
    desc.flags = RT_QUERY_MARK_INVALID;
    ASSERT_OK(rt_resolve_surfaces(scene(), &desc));
    for (size_t i = 0; i < hits.size(); ++i)
        EXPECT_TRUE(i % 3 == 0 ? is_marked(surfaces[i])
                               : std::memcmp(&surfaces[i], &expected[i], sizeof expected[i]) == 0)
            << i;
}

} // namespace
} // namespace peregrine::test
