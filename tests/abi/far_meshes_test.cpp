// Rigid meshes far from the world's origin: what a triangle and a box answer there is known.
#include "ask.h"
#include "bad_input.h"
#include "far_space.h"

namespace peregrine::test {
namespace {

const std::vector<float> kTriangle = {0, 0, 0, 2, 0, 0, 0, 0, 2};

// ------------------------------------------------------------------------------- one triangle

TEST(FarMeshes, TriangleIsHitWhereItIs) {
    for (const double far : {0.0, 100.0, 1e5, 1e6, 1e7, 1e9, 1e12, -3e15}) {
        const double place[3] = {far, far, far};
        Space space;
        space.add(kTriangle, at(place));
        space.commit();
        const rt_query_options options = relative_to(place);
        const rt_ray ray = {{0.3f, 1.7f, 0.3f}, 0, {0, 1, 0}, kInfinity};
        rt_ray down = ray;
        down.direction[1] = -1;
        const std::vector<rt_ray> rays(40, down);
        for (const uint64_t count : {uint64_t(1), uint64_t(5), uint64_t(40)})
            for (const rt_coherence hint : {RT_COHERENCE_AUTO, RT_COHERENCE_COHERENT,
                                            RT_COHERENCE_COMMON_ORIGIN, RT_COHERENCE_INCOHERENT})
                for (const bool with_stats : {false, true}) {
                    rt_query_options asked = options;
                    rt_query_stats stats = rt_default_query_stats();
                    if (with_stats) asked.stats = &stats;
                    std::vector<rt_hit> hits(count), all(count);
                    std::vector<uint8_t> occluded(count);
                    std::vector<uint32_t> stored(count), counts(count);
                    rt_query_desc desc = rt_default_query_desc();
                    desc.rays = rays.data();
                    desc.ray_count = count;
                    desc.coherence = hint;
                    desc.options = &asked;
                    desc.hits = hits.data();
                    EXPECT_OK(rt_trace_query(space.scene, &desc));
                    desc.kind = RT_QUERY_ALL;
                    desc.hits = all.data();
                    desc.hit_counts = stored.data();
                    desc.max_hits = 1;
                    EXPECT_OK(rt_trace_query(space.scene, &desc));
                    desc.kind = RT_QUERY_COUNT;
                    desc.hits = nullptr;
                    desc.hit_counts = counts.data();
                    desc.max_hits = 0;
                    EXPECT_OK(rt_trace_query(space.scene, &desc));
                    desc.kind = RT_QUERY_ANY;
                    desc.hit_counts = nullptr;
                    desc.occluded = occluded.data();
                    EXPECT_OK(rt_trace_query(space.scene, &desc));
                    for (size_t i = 0; i < count; ++i) {
                        EXPECT_EQ(hits[i].t, 1.7f) << far;
                        EXPECT_EQ(all[i].t, 1.7f) << far;
                        EXPECT_EQ(stored[i], 1u) << far;
                        EXPECT_EQ(counts[i], 1u) << far;
                        EXPECT_EQ(occluded[i], 1) << far;
                    }
                }
        const rt_nearest nearest = nearest_one(space.scene, {{0.3f, 1.7f, 0.3f}, 5}, &options);
        EXPECT_EQ(nearest.distance, 1.7f) << far;
        EXPECT_EQ(nearest.point[1], 0.0f) << far;
        const rt_sweep_hit contact = sweep_one(
            space.scene, {{0.3f, 1.7f, 0.3f}, 0.5f, {0, 0, 0}, 9, {0, -1, 0}, 0}, &options);
        EXPECT_EQ(contact.t, 1.2f) << far;
        EXPECT_EQ(contact.normal[1], 1.0f) << far;
        EXPECT_EQ(trace_one(space.scene, ray, &options).triangle, RT_NO_TRIANGLE) << far;
    }
}

// ------------------------------------------------------------------------------------- one box

TEST(FarMeshes, BoxIsTouchedAndSeen) {
    for (const double far : {3e7, 2e8, 1e11}) {
        const double place[3] = {far, 0, 0};
        Space space;
        const rt_mesh box = space.add(box_corners(), at(place));
        space.commit();
        const rt_query_options options = relative_to(place);
        EXPECT_TRUE(overlaps_one(space.scene,
                                 {{1.05f, 0, 0}, 0.1f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                                 &options));
        EXPECT_FALSE(overlaps_one(space.scene,
                                  {{1.15f, 0, 0}, 0.1f, {0, 0, 0}, RT_SHAPE_SPHERE, {0, 0, 0, 0}},
                                  &options));
        EXPECT_TRUE(overlaps_one(space.scene,
                                 {{1.05f, 0, 0}, 0, {0.1f, 0.1f, 0.1f}, RT_SHAPE_BOX, {0, 0, 0, 1}},
                                 &options));
        const rt_hit hit =
            trace_one(space.scene, {{5, 0.25f, 0.5f}, 0, {-1, 0, 0}, kInfinity}, &options);
        EXPECT_EQ(hit.t, 4.0f);
        EXPECT_EQ(hit.back_face, 0u);
        EXPECT_EQ(hit.mesh.index, box.index);

        rt_camera camera = rt_default_camera();
        camera.position[0] = far + 5;
        camera.forward[0] = -1;
        camera.forward[2] = 0;
        float depth[9];
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = frame.height = 3;
        frame.depth = depth;
        EXPECT_OK(rt_render_frame(space.scene, &camera, &frame, nullptr));
        EXPECT_EQ(depth[4], 4.0f);
    }
}

TEST(FarMeshes, EndsOfTheRange) {
    for (const double far : {1e18, 1e24, 9e29}) {
        const double place[3] = {far, -far, far};
        Space space;
        space.add(kTriangle, at(place));
        space.commit();
        const rt_query_options options = relative_to(place);
        const rt_ray ray = {{0.3f, 1.7f, 0.3f}, 0, {0, -1, 0}, kInfinity};
        EXPECT_EQ(trace_one(space.scene, ray, &options).t, 1.7f) << far;
        EXPECT_EQ(nearest_one(space.scene, {{0.3f, 1.7f, 0.3f}, 5}, &options).distance, 1.7f)
            << far;
        EXPECT_EQ(trace_one(space.scene, ray).triangle, RT_NO_TRIANGLE) << far;
    }
}

} // namespace
} // namespace peregrine::test
