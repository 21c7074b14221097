#pragma once

#include "check.h"
#include "peregrine/rt.h"
#include "query/query.h"
#include "read_struct.h"

namespace peregrine::abi {

// What all descriptions of queries say alike; `faces` is checked already.
template <class Desc>
query::Selection selected_meshes(const Desc& desc) {
    query::Selection selection;
    selection.faces = trace::Faces(desc.faces);
    selection.layer_mask = desc.layer_mask;
    selection.ignore_mesh = to_handle(desc.ignore_mesh);
    return selection;
}

// The point that a query's records are relative to; without options the world's own origin.
inline math::Vec3d origin_of(const rt_query_options* options) {
    return options ? math::Vec3d(options->origin[0], options->origin[1], options->origin[2])
                   : math::Vec3d(0);
}

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
        return origin_of(&fields_) - snapshot.origin;
    }
    bool wants_stats() const { return fields_.stats != nullptr; }
    void write_stats(const trace::Counters& counters) const;

private:
    static bool ask(void* options, uint64_t index, const query::Hit& candidate);

    rt_query_options fields_;
    Output<rt_query_stats> stats_;
};

} // namespace peregrine::abi
