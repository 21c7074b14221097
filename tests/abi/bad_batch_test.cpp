// Batches and arrays of rays that the door refuses.
#include "bad_input.h"
#include "ray_batch.h"

namespace peregrine::test {
namespace {

constexpr rt_ray kGoodRay = {{0, 5, 0}, 0, {0, -1, 0}, 100};

struct ArrayQuery {
    explicit ArrayQuery(size_t count)
        : records(count, kGoodRay), in(records, 0), out(count, 0), occluded(count, 7) {
        desc.ray_count = count;
        desc.ray_arrays = &in.arrays;
        desc.hit_arrays = &out.arrays;
        desc.occluded = occluded.data();
    }

    bool unwritten() const {
        for (size_t i = 0; i < out.count; ++i)
            if (out.triangle.at(i) != 0xa5a5a5a5u || out.back_face.at(i) != 0xa5a5a5a5u
                || occluded[i] != 7)
                return false;
        return true;
    }

    std::vector<rt_ray> records;
    RayBatch in;
    HitBatch out;
    std::vector<uint8_t> occluded;
    rt_query_desc desc = rt_default_query_desc();
};

class BadBatch : public BadInput {
protected:
    template <class Spoil>
    void refuse(size_t count, Spoil&& spoil, rt_result expected, const std::string& words) {
        for (const rt_query_kind kind : {RT_QUERY_CLOSEST, RT_QUERY_ANY}) {
            ArrayQuery query(count);
            query.desc.kind = kind;
            spoil(query);
            expect_refused(rt_trace_query(scene(), &query.desc), expected, words);
            EXPECT_TRUE(query.unwritten());
        }
    }
};

TEST_F(BadBatch, OneFormOfRaysAndOneOfHits) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    for (const size_t count : {1u, 5u, 20u}) {
        refuse(
            count, [](ArrayQuery& q) { q.desc.rays = q.records.data(); }, kArgument,
            "rt_query_desc.rays and rt_query_desc.ray_arrays are both given");
        refuse(
            count, [](ArrayQuery& q) { q.desc.ray_arrays = nullptr; }, kArgument,
            "rt_query_desc.rays is null, and so is rt_query_desc.ray_arrays");
        ArrayQuery query(count);
        std::vector<rt_hit> hits(count);
        query.desc.hits = hits.data();
        expect_refused(rt_trace_query(scene(), &query.desc), kArgument,
                       "rt_query_desc.hits and rt_query_desc.hit_arrays are both given");
        query.desc.hits = nullptr;
        query.desc.hit_arrays = nullptr;
        expect_refused(rt_trace_query(scene(), &query.desc), kArgument,
                       "rt_query_desc.hits is null, and so is rt_query_desc.hit_arrays");
        EXPECT_TRUE(query.unwritten());
    }
}

TEST_F(BadBatch, ArrayFields) {
    constexpr auto kArgument = RT_ERROR_INVALID_ARGUMENT;
    using Q = ArrayQuery;
    for (const size_t count : {1u, 20u}) {
        for (size_t k = 0; k < 3; ++k) {
            std::string axis(1, '[');
            axis += char('0' + k);
            axis += "] is null";
            refuse(
                count, [&](Q& q) { q.in.arrays.origin[k] = nullptr; }, kArgument,
                "rt_ray_arrays.origin" + axis);
            refuse(
                count, [&](Q& q) { q.in.arrays.direction[k] = nullptr; }, kArgument,
                "rt_ray_arrays.direction" + axis);
        }
        refuse(
            count, [](Q& q) { q.in.arrays.reserved = 1; }, kArgument, "rt_ray_arrays.reserved");
        refuse(
            count, [](Q& q) { q.in.arrays.struct_size = 71; }, RT_ERROR_INVALID_STRUCT,
            "rt_ray_arrays.struct_size is 71");
        Q closest(count);
        closest.out.arrays.reserved = 2;
        expect_refused(rt_trace_query(scene(), &closest.desc), kArgument, "rt_hit_arrays.reserved");
        closest.out.arrays.reserved = 0;
        closest.out.arrays.struct_size = 0;
        expect_refused(rt_trace_query(scene(), &closest.desc), RT_ERROR_INVALID_STRUCT,
                       "rt_hit_arrays.struct_size is 0");
        EXPECT_TRUE(closest.unwritten());
    }
    for (const uint64_t count : {uint64_t(1) << 62, ~uint64_t(0)})
        refuse(
            8, [&](Q& q) { q.desc.ray_count = count; }, RT_ERROR_LIMIT, "rt_ray_arrays");
}

// Wherever the bad ray is, it is named, and nothing in front of it is answered.
TEST_F(BadBatch, ABadRayAnywhereIsNamed) {
    constexpr size_t kCount = 2100;
    std::vector<rt_hit> hits(kCount);
    for (const size_t place :
         {0u, 1u, 14u, 15u, 16u, 500u, 1023u, 1024u, 1025u, 2047u, 2048u, 2098u, 2099u})
        for (const size_t count : {size_t(1024), kCount}) {
            if (place >= count) continue;
            const std::string words = "ray " + std::to_string(place) + ": ";
            refuse(
                count, [&](ArrayQuery& q) { q.in.lanes[1]->set(place, 2e30f); },
                RT_ERROR_INVALID_ARGUMENT, words + "origin y");
            refuse(
                count, [&](ArrayQuery& q) { q.in.lanes[5]->set(place, kNan); },
                RT_ERROR_INVALID_ARGUMENT, words + "direction z");
            refuse(
                count, [&](ArrayQuery& q) { q.in.lanes[4]->set(place, -0.0f); },
                RT_ERROR_INVALID_ARGUMENT, words + "the direction is zero");
            ArrayQuery query(count);
            query.desc.ray_arrays = nullptr;
            query.desc.rays = query.records.data();
            query.records[place].t_max = kNan;
            expect_refused(rt_trace_query(scene(), &query.desc), RT_ERROR_INVALID_ARGUMENT,
                           words + "t_max is NaN");
            EXPECT_TRUE(query.unwritten());
        }
}

TEST_F(BadBatch, EveryComponentIsLookedAt) {
    for (size_t lane = 0; lane < 8; ++lane)
        for (const float value : {kNan, kInfinity, -kInfinity}) {
            if (lane >= 6 && value == value) continue; // ranges may be infinite
            refuse(
                40, [&](ArrayQuery& q) { q.in.lanes[lane]->set(33, value); },
                RT_ERROR_INVALID_ARGUMENT, "ray 33: ");
            ArrayQuery query(40);
            query.desc.ray_arrays = nullptr;
            query.desc.rays = query.records.data();
            rt_ray& ray = query.records[33];
            float* const members[] = {&ray.origin[0],    &ray.origin[1],    &ray.origin[2],
                                      &ray.direction[0], &ray.direction[1], &ray.direction[2],
                                      &ray.t_min,        &ray.t_max};
            *members[lane] = value;
            expect_refused(rt_trace_query(scene(), &query.desc), RT_ERROR_INVALID_ARGUMENT,
                           "ray 33: ");
            EXPECT_TRUE(query.unwritten());
        }
}

} // namespace
} // namespace peregrine::test
