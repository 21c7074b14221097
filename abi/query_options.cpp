#include "query_options.h"

#include "check.h"
#include "query_records.h"
#include "read_struct.h"

namespace peregrine::abi {

QueryOptions::QueryOptions(const rt_query_options* options)
    : fields_(options ? read_struct(options) : rt_default_query_options()), stats_(fields_.stats) {
    if (!options) return;
    require_zero(fields_.reserved, "rt_query_options.reserved");
    require_position(fields_.origin, "rt_query_options.origin");
    if (fields_.ignore_count == 0) return;
    require_pointer(fields_.ignore_meshes, "rt_query_options.ignore_meshes");
    require_addressable(fields_.ignore_meshes, fields_.ignore_count, sizeof(rt_mesh),
                        sizeof(rt_mesh), "rt_query_options.ignore_meshes");
}

void QueryOptions::select(query::Selection& selection) const {
    selection.ignore_meshes = {reinterpret_cast<const base::Handle*>(fields_.ignore_meshes),
                               size_t(fields_.ignore_count)};
    if (fields_.accept) selection.accept = {&ask, const_cast<rt_query_options*>(&fields_)};
}

bool QueryOptions::ask(void* options, uint64_t index, const query::Hit& candidate) {
    const auto& fields = *static_cast<const rt_query_options*>(options);
    return fields.accept(fields.accept_user, index, reinterpret_cast<const rt_hit*>(&candidate))
           != 0;
}

void QueryOptions::write_stats(const trace::Counters& counters) const {
    rt_query_stats stats = rt_default_query_stats();
    stats.nodes = counters.nodes;
    stats.triangles = counters.triangles;
    stats.instances = counters.instances;
    stats_.write(stats);
}

} // namespace peregrine::abi
