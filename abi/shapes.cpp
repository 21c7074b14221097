#include "query/shapes.h"

#include "check.h"
#include "guard.h"
#include "query_options.h"
#include "query_records.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

// What the three descriptions say alike, and the snapshot that they ask.
class Asked {
public:
    template <class Desc>
    Asked(HostScene& host, const Desc& desc, uint32_t known_flags, const char* flags_field,
          const char* faces_field)
        : options_(desc.options), pin_(pin_snapshot(host.scene.snapshots, options_.snapshot())) {
        require_bits(desc.flags, known_flags | RT_QUERY_MARK_INVALID, flags_field);
        require_enum(desc.faces, RT_FACES_BACK, faces_field);
        query::Selection& selection = request_.selection;
        selection = selected_meshes(desc);
        selection.skip_separating = (desc.flags & RT_QUERY_SKIP_SEPARATING) != 0;
        options_.select(selection);
        if (desc.flags & RT_QUERY_USE_THREADS) request_.scheduler = &host.scene.scheduler;
        if (options_.wants_stats()) request_.counters = &counters_;
        request_.mark_invalid = (desc.flags & RT_QUERY_MARK_INVALID) != 0;
    }

    // query(snapshot, records, request, results), the records in the snapshot's own place.
    template <class Query, class Record, class Results>
    void run(Query&& query, const query::Strided<Record>& records, const Results& results) {
        const scene::Snapshot& snapshot = require_snapshot(pin_, options_.snapshot());
        query(snapshot, query::Placed<Record>{records, {options_.origin_in(snapshot)}}, request_,
              results);
    }

    void write_stats() const { options_.write_stats(counters_); }

private:
    QueryOptions options_;
    scene::SnapshotStore::Pin pin_;
    query::Request request_;
    trace::Counters counters_;
};

void sweep(HostScene& host, const rt_sweep_desc& desc) {
    Asked asked(host, desc, RT_QUERY_USE_THREADS | RT_QUERY_SKIP_SEPARATING, "rt_sweep_desc.flags",
                "rt_sweep_desc.faces");
    if (desc.sweep_count > 0) {
        const auto sweeps =
            strided<query::Sweep>(desc.sweeps, desc.sweep_count, desc.sweep_stride,
                                  "rt_sweep_desc.sweeps", "rt_sweep_desc.sweep_stride");
        asked.run(query::sweep, sweeps,
                  strided<query::SweepHit>(desc.hits, desc.sweep_count, desc.hit_stride,
                                           "rt_sweep_desc.hits", "rt_sweep_desc.hit_stride"));
    }
    asked.write_stats();
}

query::OverlapLists to_lists(const rt_overlap_desc& desc) {
    const auto counts = strided<uint32_t>(desc.overlap_counts, desc.shape_count, 0,
                                          "rt_overlap_desc.overlap_counts", "");
    if (desc.max_overlaps == 0) return {nullptr, 0, 0, counts};
    if (desc.shape_count > UINT64_MAX / desc.max_overlaps)
        base::fail(base::Code::limit,
                   "rt_overlap_desc.shape_count times max_overlaps is larger than the address "
                   "space");
    const auto hits = strided<query::OverlapHit>(
        desc.overlaps, desc.shape_count * desc.max_overlaps, 0, "rt_overlap_desc.overlaps", "");
    return {hits.data, hits.stride, desc.max_overlaps, counts};
}

void check_results(const rt_overlap_desc& desc) {
    if (desc.overlap_counts) return;
    if (!desc.overlapping)
        base::fail(base::Code::invalid_argument,
                   "rt_overlap_desc.overlapping is null, and so is overlap_counts");
    if (desc.overlaps)
        base::fail(base::Code::invalid_argument,
                   "rt_overlap_desc.overlaps is given, but overlap_counts is null");
}

void overlap(HostScene& host, const rt_overlap_desc& desc) {
    Asked asked(host, desc, RT_QUERY_USE_THREADS, "rt_overlap_desc.flags", "rt_overlap_desc.faces");
    if (desc.shape_count > 0) {
        check_results(desc);
        const auto shapes =
            strided<query::Shape>(desc.shapes, desc.shape_count, desc.shape_stride,
                                  "rt_overlap_desc.shapes", "rt_overlap_desc.shape_stride");
        query::Strided<uint8_t> overlapping{};
        if (desc.overlapping)
            overlapping = strided<uint8_t>(desc.overlapping, desc.shape_count, 0,
                                           "rt_overlap_desc.overlapping", "");
        if (desc.overlap_counts) {
            const query::OverlapLists lists = to_lists(desc);
            asked.run(query::overlap_all, shapes, lists);
            for (uint64_t i = 0; i < overlapping.count; ++i) {
                const uint32_t count = lists.counts.load(i);
                overlapping.store(i, count == RT_INVALID_COUNT ? RT_INVALID_BYTE : count != 0);
            }
        } else {
            asked.run(query::overlap_any, shapes, overlapping);
        }
    }
    asked.write_stats();
}

void nearest(HostScene& host, const rt_nearest_desc& desc) {
    Asked asked(host, desc, RT_QUERY_USE_THREADS, "rt_nearest_desc.flags", "rt_nearest_desc.faces");
    if (desc.point_count > 0) {
        const auto points =
            strided<query::Point>(desc.points, desc.point_count, desc.point_stride,
                                  "rt_nearest_desc.points", "rt_nearest_desc.point_stride");
        asked.run(query::nearest, points,
                  strided<query::NearestPoint>(desc.results, desc.point_count, desc.result_stride,
                                               "rt_nearest_desc.results",
                                               "rt_nearest_desc.result_stride"));
    }
    asked.write_stats();
}

template <class Desc>
void with(rt_scene scene, const Desc* desc, void (*ask)(HostScene&, const Desc&)) {
    HostScene& host = find_scene(scene);
    with_struct(desc, [&](const Desc& fields) { ask(host, fields); });
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_sweep_shapes(rt_scene scene, const rt_sweep_desc* desc) noexcept {
    return guard([&] { with(scene, desc, sweep); });
}

rt_result rt_overlap_shapes(rt_scene scene, const rt_overlap_desc* desc) noexcept {
    return guard([&] { with(scene, desc, overlap); });
}

rt_result rt_find_nearest(rt_scene scene, const rt_nearest_desc* desc) noexcept {
    return guard([&] { with(scene, desc, nearest); });
}
