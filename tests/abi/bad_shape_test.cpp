// Nonsense handed to the queries of shapes and to their options.
#include "bad_input.h"

#include <functional>

namespace peregrine::test {
namespace {

constexpr float kFar = 2e30f;

class BadShape : public BadInput {
protected:
    BadShape() {
        std::memset(&hits_, 0x5a, sizeof hits_);
        std::memset(&results_, 0x5a, sizeof results_);
        sweep_ = rt_default_sweep_desc();
        sweep_.sweeps = sweeps_;
        sweep_.sweep_count = 3;
        sweep_.hits = hits_;
        overlap_ = rt_default_overlap_desc();
        overlap_.shapes = shapes_;
        overlap_.shape_count = 3;
        overlap_.overlapping = overlapping_;
        nearest_ = rt_default_nearest_desc();
        nearest_.points = points_;
        nearest_.point_count = 3;
        nearest_.results = results_;
    }

    // The good records work; with `value` in this place of the second one they are refused, in
    // words, and nothing is written.
    void refuse_sweep(float& place, float value, const std::string& words) {
        const float good = std::exchange(place, value);
        expect_refused(rt_sweep_shapes(scene(), &sweep_), RT_ERROR_INVALID_ARGUMENT, words);
        EXPECT_NE(std::string(rt_get_last_error()).find("sweep 1"), std::string::npos);
        place = good;
        EXPECT_EQ(hits_[0].triangle, 0x5a5a5a5au);
    }
    void refuse_shape(float& place, float value, const std::string& words) {
        const float good = std::exchange(place, value);
        expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT, words);
        EXPECT_NE(std::string(rt_get_last_error()).find("shape 1"), std::string::npos);
        place = good;
        EXPECT_EQ(overlapping_[0], 0x5a);
    }
    void refuse_point(float& place, float value, const std::string& words) {
        const float good = std::exchange(place, value);
        expect_refused(rt_find_nearest(scene(), &nearest_), RT_ERROR_INVALID_ARGUMENT, words);
        EXPECT_NE(std::string(rt_get_last_error()).find("point 1"), std::string::npos);
        place = good;
        EXPECT_EQ(results_[0].triangle, 0x5a5a5a5au);
    }
    void expect_good() {
        EXPECT_OK(rt_sweep_shapes(scene(), &sweep_));
        EXPECT_OK(rt_overlap_shapes(scene(), &overlap_));
        EXPECT_OK(rt_find_nearest(scene(), &nearest_));
    }

    rt_sweep sweeps_[3] = {{{0, 9, 0}, 0.5f, {0, 0, 0}, 20, {0, -1, 0}, 0},
                           {{1, 9, 0}, 0.5f, {0, 0.5f, 0}, 20, {0, -1, 0}, 0},
                           {{2, 9, 0}, 0.0f, {0, 0, 0}, kInfinity, {0, -1, 0}, 0}};
    rt_sweep_hit hits_[3];
    rt_shape shapes_[3] = {{{0, 9, 0}, 0.5f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                           {{0, 1, 0}, 0.5f, {1, 1, 1}, RT_SHAPE_BOX, {0, 0, 0, 1}},
                           {{0, 1, 0}, 0.5f, {0, 1, 0}, RT_SHAPE_CAPSULE, {0, 0, 0, 0}}};
    uint8_t overlapping_[3] = {0x5a, 0x5a, 0x5a};
    rt_point points_[3] = {{{0, 1, 0}, 5}, {{1, 1, 0}, 5}, {{2, 1, 0}, 0}};
    rt_nearest results_[3];
    rt_sweep_desc sweep_;
    rt_overlap_desc overlap_;
    rt_nearest_desc nearest_;
};

TEST_F(BadShape, Records) {
    refuse_point(points_[1].radius, kNan, "radius");
    for (const float bad : {kNan, kInfinity, -kInfinity, kFar, -kFar}) {
        for (int k = 0; k < 3; ++k) {
            refuse_sweep(sweeps_[1].center[k], bad, "center");
            refuse_sweep(sweeps_[1].axis[k], bad, "axis");
            refuse_sweep(sweeps_[1].direction[k], bad, "direction");
            refuse_shape(shapes_[1].center[k], bad, "center");
            refuse_shape(shapes_[1].extent[k], bad, "extent");
            refuse_point(points_[1].position[k], bad, "position");
        }
        refuse_sweep(sweeps_[1].radius, bad, "radius");
        refuse_shape(shapes_[1].rotation[2], bad, "rotation");
    }
    refuse_sweep(sweeps_[1].radius, -0.5f, "radius");
    refuse_sweep(sweeps_[1].t_max, kNan, "t_max");
    refuse_sweep(sweeps_[1].direction[1], 0, "direction");
    refuse_shape(shapes_[1].extent[0], -1, "extent");
    refuse_shape(shapes_[1].rotation[3], 0, "rotation");
    shapes_[1].kind = 3;
    expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT, "kind");
    shapes_[1].kind = RT_SHAPE_BOX;
    expect_good();
}

TEST_F(BadShape, Descriptions) {
    const auto expect_bad = [&](const std::string& words) {
        expect_refused(rt_sweep_shapes(scene(), &sweep_), RT_ERROR_INVALID_ARGUMENT, words);
        expect_refused(rt_find_nearest(scene(), &nearest_), RT_ERROR_INVALID_ARGUMENT, words);
        expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT, words);
    };
    sweep_.flags = nearest_.flags = overlap_.flags = 1u << 9;
    expect_bad("flags");
    sweep_.flags = nearest_.flags = overlap_.flags = RT_QUERY_ALPHA_TEST;
    expect_bad("flags");
    sweep_.flags = nearest_.flags = overlap_.flags = 0;
    sweep_.faces = nearest_.faces = overlap_.faces = 3;
    expect_bad("faces");
    sweep_.faces = nearest_.faces = overlap_.faces = RT_FACES_BOTH;
    sweep_.sweep_stride = nearest_.point_stride = overlap_.shape_stride = 8;
    expect_bad("stride");
    sweep_.sweep_stride = nearest_.point_stride = overlap_.shape_stride = 0;
    sweep_.sweeps = nullptr;
    nearest_.points = nullptr;
    overlap_.shapes = nullptr;
    expect_bad("null");
    sweep_.sweep_count = nearest_.point_count = overlap_.shape_count = 0;
    expect_good(); // nothing to do
}

TEST_F(BadShape, Results) {
    sweep_.hits = nullptr;
    expect_refused(rt_sweep_shapes(scene(), &sweep_), RT_ERROR_INVALID_ARGUMENT, "hits");
    nearest_.results = nullptr;
    expect_refused(rt_find_nearest(scene(), &nearest_), RT_ERROR_INVALID_ARGUMENT, "results");
    overlap_.overlapping = nullptr;
    expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT, "overlapping");
    rt_overlap touched[6];
    uint32_t counts[3] = {7, 7, 7};
    overlap_.overlaps = touched;
    overlap_.max_overlaps = 2;
    expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT,
                   "overlap_counts");
    overlap_.overlap_counts = counts;
    overlap_.overlaps = nullptr;
    expect_refused(rt_overlap_shapes(scene(), &overlap_), RT_ERROR_INVALID_ARGUMENT, "overlaps");
    EXPECT_EQ(counts[0], 7u);
    overlap_.overlaps = touched;
    overlap_.shape_count = UINT64_MAX / 3;
    overlap_.max_overlaps = 0xffffffffu;
    EXPECT_NE(rt_overlap_shapes(scene(), &overlap_), RT_OK);
}

TEST_F(BadShape, Scenes) {
    for (const rt_scene none : {rt_scene{}, rt_scene{77, 1}}) {
        expect_refused(rt_sweep_shapes(none, &sweep_), RT_ERROR_INVALID_HANDLE, "scene");
        expect_refused(rt_overlap_shapes(none, &overlap_), RT_ERROR_INVALID_HANDLE, "scene");
        expect_refused(rt_find_nearest(none, &nearest_), RT_ERROR_INVALID_HANDLE, "scene");
    }
    expect_refused(rt_sweep_shapes(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT, "rt_sweep_desc");
    expect_refused(rt_overlap_shapes(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT,
                   "rt_overlap_desc");
    expect_refused(rt_find_nearest(scene(), nullptr), RT_ERROR_INVALID_ARGUMENT, "rt_nearest_desc");
    sweep_.struct_size = 3;
    expect_refused(rt_sweep_shapes(scene(), &sweep_), RT_ERROR_INVALID_STRUCT, "struct_size");

    rt_scene empty;
    const rt_scene_desc desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&desc, &empty));
    sweep_.struct_size = sizeof sweep_;
    expect_refused(rt_sweep_shapes(empty, &sweep_), RT_ERROR_NOT_COMMITTED, "rt_commit_scene");
    ASSERT_OK(rt_destroy_scene(empty));
}

TEST_F(BadShape, Options) {
    rt_query_options options = rt_default_query_options();
    sweep_.options = nearest_.options = overlap_.options = &options;
    const auto expect_bad = [&](rt_result result, const std::string& words) {
        expect_refused(rt_sweep_shapes(scene(), &sweep_), result, words);
        expect_refused(rt_find_nearest(scene(), &nearest_), result, words);
        expect_refused(rt_overlap_shapes(scene(), &overlap_), result, words);
    };
    options.struct_size = 4;
    expect_bad(RT_ERROR_INVALID_STRUCT, "rt_query_options.struct_size");
    options.struct_size = sizeof options;
    options.reserved = 1;
    expect_bad(RT_ERROR_INVALID_ARGUMENT, "rt_query_options.reserved");
    options.reserved = 0;
    options.origin[1] = std::numeric_limits<double>::quiet_NaN();
    expect_bad(RT_ERROR_INVALID_ARGUMENT, "rt_query_options.origin[1]");
    options.origin[1] = 0;
    options.ignore_count = 2;
    expect_bad(RT_ERROR_INVALID_ARGUMENT, "rt_query_options.ignore_meshes");
    options.ignore_count = 0;
    options.snapshot = {5, 6};
    expect_bad(RT_ERROR_INVALID_HANDLE, "rt_snapshot");
    options.snapshot = {};
    rt_query_stats stats = rt_default_query_stats();
    stats.struct_size = 1;
    options.stats = &stats;
    expect_bad(RT_ERROR_INVALID_STRUCT, "rt_query_stats.struct_size");
    stats.struct_size = sizeof stats;
    expect_good();
    EXPECT_GT(stats.triangles, 0u);
}

} // namespace
} // namespace peregrine::test
