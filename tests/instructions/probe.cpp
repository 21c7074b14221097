// Does fixed work in the hall, for valgrind's callgrind to count the instructions of each piece:
// measure.py runs it and reads what was counted.
#include "questions.h"
#include "support/frame_look.h"

#include "camera.h"
#include "cameras.h"
#include "gltf/import.h"
#include "stage.h"
#include "upload.h"

#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else // measure.py says that there is no valgrind
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name) (void)(name)
#endif

namespace {

using namespace peregrine::test;

void count(const char* name, const std::function<void()>& work) {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    work();
    CALLGRIND_DUMP_STATS_AT(name);
    CALLGRIND_STOP_INSTRUMENTATION;
}

// Once before, so that memory and caches are there.
void count_again(const char* name, const std::function<void()>& work) {
    work();
    count(name, work);
}

class Probe {
public:
    explicit Probe(const std::string& file)
        : level_(host::gltf::import_file(file)),
          stage_(*rt_get_api(RT_API_VERSION), 1, RT_ISA_AVX2), // what valgrind knows
          questions_(places_of(level_)), memory_(256, 144) {
        lights_ = host::upload_level(stage_, level_, 0.1f).lights;
        commit();
    }

    void frames() {
        count("frame, exact, the first", [&] { render(Look::exact); });
        count_again("frame, exact", [&] { render(Look::exact); });
        count_again("frame, visibility", [&] { render(Look::visibility); });
    }

    void commits() {
        double away = 0;
        count_again("commit, a lamp moved", [&] {
            away += 0.25;
            host::Light light = level_.lights[0];
            light.position.y += away;
            const rt_light_desc desc = host::describe_light(light);
            check(rt_update_light(stage_.scene(), lights_[0], &desc));
            commit();
        });
    }

    void rays() {
        std::vector<rt_hit> hits(questions_.rays.size() * 4);
        std::vector<uint32_t> counts(questions_.rays.size());
        std::vector<uint8_t> occluded(questions_.rays.size());
        rt_query_desc query = rt_default_query_desc();
        query.rays = questions_.rays.data();
        query.hits = hits.data();
        query.occluded = occluded.data();
        query.hit_counts = counts.data();
        query.ray_count = 1;
        count_again("closest hit, one a call", [&] { trace_singly(query); });
        query.ray_count = questions_.rays.size();
        count_again("closest hit, a batch", [&] { trace(query); });
        query.kind = RT_QUERY_ALL;
        query.max_hits = 4;
        count_again("first crossings, a batch", [&] { trace(query); });
        query.kind = RT_QUERY_ANY;
        query.rays = questions_.sights.data();
        count_again("any hit, a batch", [&] { trace(query); });
        query.ray_count = 1;
        count_again("any hit, one a call", [&] { trace_singly(query); });
    }

    void shapes() {
        std::vector<rt_sweep_hit> hits(questions_.spheres.size());
        rt_sweep_desc sweep = rt_default_sweep_desc();
        sweep.sweep_count = hits.size();
        sweep.hits = hits.data();
        sweep.sweeps = questions_.spheres.data();
        count_again("sweeps of a sphere", [&] { check(rt_sweep_shapes(stage_.scene(), &sweep)); });
        sweep.sweeps = questions_.capsules.data();
        count_again("sweeps of a capsule", [&] { check(rt_sweep_shapes(stage_.scene(), &sweep)); });

        std::vector<uint8_t> overlapping(questions_.shapes.size());
        rt_overlap_desc overlap = rt_default_overlap_desc();
        overlap.shapes = questions_.shapes.data();
        overlap.shape_count = overlapping.size();
        overlap.overlapping = overlapping.data();
        count_again("overlaps of a sphere",
                    [&] { check(rt_overlap_shapes(stage_.scene(), &overlap)); });

        std::vector<rt_nearest> results(questions_.points.size());
        rt_nearest_desc nearest = rt_default_nearest_desc();
        nearest.points = questions_.points.data();
        nearest.point_count = results.size();
        nearest.results = results.data();
        count_again("nearest points", [&] { check(rt_find_nearest(stage_.scene(), &nearest)); });
    }

private:
    static std::vector<glm::vec3> places_of(const host::Level& level) {
        std::vector<glm::vec3> places;
        for (const host::Viewpoint& camera : level.cameras) places.emplace_back(camera.position);
        return places;
    }

    void check(rt_result result) const { stage_.check(result, "a call"); }

    void commit() {
        rt_commit_desc desc = rt_default_commit_desc();
        check(rt_commit_scene(stage_.scene(), &desc, nullptr));
    }

    void render(Look look) {
        const host::Viewpoint& view = level_.cameras.at(0);
        const rt_camera camera = host::camera_of(view);
        const rt_frame_desc frame = memory_.frame(look);
        check(rt_render_frame(stage_.scene(), &camera, &frame, nullptr));
    }

    void trace(const rt_query_desc& query) const { check(rt_trace_query(stage_.scene(), &query)); }
    void trace_singly(rt_query_desc query) const {
        for (size_t i = 0; i < questions_.rays.size(); ++i, ++query.rays) trace(query);
    }

    host::Level level_;
    host::Stage stage_;
    Questions questions_;
    FrameMemory memory_;
    std::vector<rt_light> lights_;
};

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s HALL.glb\n", argv[0]), 2;
    try {
        Probe probe(argv[1]);
        probe.frames();
        probe.commits();
        probe.rays();
        probe.shapes();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
}
