#pragma once

#include "reference.h"
#include "trace_scene.h"

#include <peregrine/rt.h>

#include <span>
#include <string>
#include <vector>

namespace peregrine::bench {

enum class QueryKind { any, closest, stream, all, sweep, overlap, nearest };

// What the table calls a row's queries.
struct QueryItem {
    const char* name;
    QueryKind kind;
    const char* text;
};
std::span<const QueryItem> query_items();

// Queries of one kind as the header has them, the same for all contestants: one list is filled.
struct QuerySet {
    QueryKind kind;
    std::vector<rt_ray> rays;
    std::vector<rt_sweep> sweeps;
    std::vector<rt_shape> shapes;
    std::vector<rt_point> points;

    size_t size() const { return rays.size() + sweeps.size() + shapes.size() + points.size(); }
};

// Moved and rounded to float, as libraries that know no origin want it.
QuerySet moved(QuerySet set, const math::Vec3d& offset);
QuerySet scaled(QuerySet set, float scale);

// Makes the sets of a scene from random points of its free space: those that a random walk reaches
// from the cameras, each step a part of the way to what a random ray meets. Nothing but the
// reference is asked, and sets are the same for the same scene and count.
class QueryMaker {
public:
    // `way` is how far sweeps and crossings go, in metres; 0: 10% of the scene's diagonal.
    QueryMaker(const TraceScene& scene, const Reference& reference, float way);

    QuerySet make(const QueryItem& item, size_t count) const;

private:
    const Reference& reference_;
    float way_;
    std::vector<math::Vec3> points_;
};

} // namespace peregrine::bench
