#pragma once

#include "peregrine/rt.h"
#include "query/query.h"
#include "read_struct.h"

namespace peregrine::abi {

// rt_query_options, read and checked; the defaults for null. Stays where it is while a query runs.
class QueryOptions {
public:
    explicit QueryOptions(const rt_query_options* options);
    QueryOptions(const QueryOptions&) = delete;
    QueryOptions& operator=(const QueryOptions&) = delete;

    // The ignored meshes and the callback.
    void select(query::Selection& selection) const;
    rt_snapshot snapshot() const { return fields_.snapshot; }
    // Of the records, as the snapshot counts positions.
    math::Vec3d origin_in(const scene::Snapshot& snapshot) const {
        return math::Vec3d(fields_.origin[0], fields_.origin[1], fields_.origin[2])
               - snapshot.origin;
    }
    bool wants_stats() const { return fields_.stats != nullptr; }
    void write_stats(const trace::Counters& counters) const;

private:
    static bool ask(void* options, uint64_t index, const query::Hit& candidate);

    rt_query_options fields_;
    Output<rt_query_stats> stats_;
};

} // namespace peregrine::abi
