// Batches of every size and form, with hints true and false, answer as single rays do.
#include "ray_batch.h"

#include <limits>

namespace peregrine::test {
namespace {

// As many rays as wanted, none like another, some of which miss.
std::vector<rt_ray> rays_from_above(size_t count) {
    std::vector<rt_ray> rays;
    for (size_t i = 0; i < count; ++i) {
        const float a = float(i * 37 % 101) / 101, b = float(i * 53 % 89) / 89;
        const float t_max = i % 5 ? std::numeric_limits<float>::infinity() : 4.5f;
        rays.push_back({{9 * a - 4.5f, 6, 9 * b - 4.5f}, 0, {b - 0.5f, -1, 0.5f - a}, t_max});
    }
    return rays;
}

class Batch : public testing::Test {
protected:
    std::vector<rt_hit> one_by_one(const std::vector<rt_ray>& rays, uint32_t flags = 0) {
        std::vector<rt_hit> hits(rays.size());
        rt_query_desc desc = rt_default_query_desc();
        desc.flags = flags;
        desc.ray_count = 1;
        for (size_t i = 0; i < rays.size(); ++i) {
            desc.rays = &rays[i];
            desc.hits = &hits[i];
            EXPECT_OK(rt_trace_query(world_->scene, &desc));
        }
        return hits;
    }

    rt_scene scene() { return world_->scene; }

    WorldGuard world_;
};

constexpr size_t kSizes[] = {1, 2, 7, 8, 9, 15, 16, 17, 100, 1023, 1024, 1025, 1040, 2500};

TEST_F(Batch, OfEverySizeAndFormAnswersAsSingleRays) {
    for (const size_t count : kSizes) {
        const std::vector<rt_ray> rays = rays_from_above(count);
        const std::vector<rt_hit> expected = one_by_one(rays);
        std::vector<rt_hit> hits(count);
        std::vector<uint8_t> occluded(count, 7);
        rt_query_desc desc = rt_default_query_desc();
        desc.rays = rays.data();
        desc.ray_count = count;
        desc.hits = hits.data();
        desc.occluded = occluded.data();
        for (rt_coherence c = RT_COHERENCE_AUTO; c <= RT_COHERENCE_INCOHERENT; ++c) {
            desc.coherence = c;
            desc.kind = RT_QUERY_CLOSEST;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            ASSERT_EQ(bytes_of(hits), bytes_of(expected)) << count;
            desc.kind = RT_QUERY_ANY;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            for (size_t i = 0; i < count; ++i)
                ASSERT_EQ(occluded[i], expected[i].triangle != RT_NO_TRIANGLE) << i;
        }
    }
}

TEST_F(Batch, ArraysAnswerAsRecordsAtAnyAlignment) {
    for (const size_t count : kSizes)
        for (const size_t offset : {0u, 16u, 4u, 1u}) {
            const std::vector<rt_ray> rays = rays_from_above(count);
            const std::vector<rt_hit> expected = one_by_one(rays);
            const RayBatch in(rays, offset);
            const HitBatch out(count, offset);
            std::vector<uint8_t> occluded(3 * count, 7);
            rt_query_desc desc = rt_default_query_desc();
            desc.ray_count = count;
            desc.ray_arrays = &in.arrays;
            desc.hit_arrays = &out.arrays;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            ASSERT_EQ(bytes_of(out.hits()), bytes_of(expected)) << count << " at " << offset;
            desc.kind = RT_QUERY_ANY;
            desc.occluded = occluded.data();
            desc.result_stride = 3;
            ASSERT_OK(rt_trace_query(scene(), &desc));
            for (size_t i = 0; i < count; ++i) {
                ASSERT_EQ(occluded[3 * i], expected[i].triangle != RT_NO_TRIANGLE) << i;
                ASSERT_TRUE(i + 1 == count || occluded[3 * i + 1] == 7);
            }
        }
}

TEST_F(Batch, RaysOfOneOriginMaySaySo) {
    std::vector<rt_ray> rays = rays_from_above(1500);
    for (rt_ray& ray : rays) {
        ray.origin[0] = ray.origin[2] = 0.25f;
        ray.t_max = std::numeric_limits<float>::infinity();
    }
    std::vector<rt_hit> hits(rays.size());
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = rays.data();
    desc.ray_count = rays.size();
    desc.hits = hits.data();
    desc.flags = RT_QUERY_ALPHA_TEST;
    const std::vector<rt_hit> expected = one_by_one(rays, desc.flags);
    for (rt_coherence c = RT_COHERENCE_AUTO; c <= RT_COHERENCE_INCOHERENT; ++c) {
        desc.coherence = c;
        ASSERT_OK(rt_trace_query(scene(), &desc));
        EXPECT_EQ(bytes_of(hits), bytes_of(expected)) << c;
    }
}

TEST_F(Batch, AnAbsentRangeIsTheWholeRayAndAbsentResultsAreNotWanted) {
    for (const size_t count : {5u, 64u, 1100u}) {
        std::vector<rt_ray> rays = rays_from_above(count);
        for (rt_ray& ray : rays) ray.t_max = std::numeric_limits<float>::infinity();
        const std::vector<rt_hit> expected = one_by_one(rays);
        RayBatch in(rays, 0);
        in.arrays.t_min = in.arrays.t_max = nullptr;
        const HitBatch all(count, 0);
        rt_query_desc desc = rt_default_query_desc();
        desc.ray_count = count;
        desc.ray_arrays = &in.arrays;
        desc.hit_arrays = &all.arrays;
        ASSERT_OK(rt_trace_query(scene(), &desc));
        EXPECT_EQ(bytes_of(all.hits()), bytes_of(expected));

        const HitBatch some(count, 0);
        rt_hit_arrays wanted = rt_default_hit_arrays();
        wanted.triangle = some.arrays.triangle;
        desc.hit_arrays = &wanted;
        ASSERT_OK(rt_trace_query(scene(), &desc));
        for (size_t i = 0; i < count; ++i) {
            EXPECT_EQ(some.triangle.at(i), expected[i].triangle);
            EXPECT_EQ(some.back_face.at(i), 0xa5a5a5a5u);
        }
    }
}

} // namespace
} // namespace peregrine::test
