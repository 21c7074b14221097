#include "query_desc.h"

#include "query_options.h"
#include "query_records.h"
#include "read_struct.h"

namespace peregrine::abi {
namespace {

static_assert(RT_COHERENCE_AUTO == int(trace::Coherence::automatic));
static_assert(RT_COHERENCE_COHERENT == int(trace::Coherence::coherent));
static_assert(RT_COHERENCE_COMMON_ORIGIN == int(trace::Coherence::common_origin));
static_assert(RT_COHERENCE_INCOHERENT == int(trace::Coherence::incoherent));

// One of the two, not both, not neither.
void require_one(const void* records, const void* arrays, const char* records_field,
                 const char* arrays_field) {
    if (!records && !arrays)
        base::fail(base::Code::invalid_argument, "%s is null, and so is %s", records_field,
                   arrays_field);
    if (records && arrays)
        base::fail(base::Code::invalid_argument, "%s and %s are both given; one must be null",
                   records_field, arrays_field);
}

template <class T>
T* require_array(T* data, uint64_t count, const char* field) {
    require_pointer(data, field);
    require_addressable(data, count, sizeof(T), sizeof(T), field);
    return data;
}

template <class T>
T* optional_array(T* data, uint64_t count, const char* field) {
    return data ? require_array(data, count, field) : nullptr;
}

query::RayArrays to_arrays(const rt_ray_arrays& in, uint64_t count) {
    require_zero(in.reserved, "rt_ray_arrays.reserved");
    return {{require_array(in.origin[0], count, "rt_ray_arrays.origin[0]"),
             require_array(in.origin[1], count, "rt_ray_arrays.origin[1]"),
             require_array(in.origin[2], count, "rt_ray_arrays.origin[2]"),
             optional_array(in.t_min, count, "rt_ray_arrays.t_min"),
             require_array(in.direction[0], count, "rt_ray_arrays.direction[0]"),
             require_array(in.direction[1], count, "rt_ray_arrays.direction[1]"),
             require_array(in.direction[2], count, "rt_ray_arrays.direction[2]"),
             optional_array(in.t_max, count, "rt_ray_arrays.t_max")}};
}

query::HitArrays to_arrays(const rt_hit_arrays& in, uint64_t count) {
    require_zero(in.reserved, "rt_hit_arrays.reserved");
    return {optional_array(in.t, count, "rt_hit_arrays.t"),
            optional_array(in.u, count, "rt_hit_arrays.u"),
            optional_array(in.v, count, "rt_hit_arrays.v"),
            optional_array(in.triangle, count, "rt_hit_arrays.triangle"),
            reinterpret_cast<base::Handle*>(optional_array(in.mesh, count, "rt_hit_arrays.mesh")),
            optional_array(in.back_face, count, "rt_hit_arrays.back_face")};
}

} // namespace

query::Selection to_selection(const rt_query_desc& desc) {
    require_enum(desc.kind, RT_QUERY_COUNT, "rt_query_desc.kind");
    require_enum(desc.faces, RT_FACES_BACK, "rt_query_desc.faces");
    require_enum(desc.coherence, RT_COHERENCE_INCOHERENT, "rt_query_desc.coherence");
    require_bits(desc.flags, RT_QUERY_ALPHA_TEST | RT_QUERY_USE_THREADS | RT_QUERY_MARK_INVALID,
                 "rt_query_desc.flags");
    require_zero(desc.reserved, "rt_query_desc.reserved");
    query::Selection selection = selected_meshes(desc);
    selection.alpha_test = (desc.flags & RT_QUERY_ALPHA_TEST) != 0;
    selection.coherence = trace::Coherence(desc.coherence);
    return selection;
}

query::Rays to_rays(const rt_query_desc& desc) {
    require_one(desc.rays, desc.ray_arrays, "rt_query_desc.rays", "rt_query_desc.ray_arrays");
    if (!desc.rays)
        return {desc.ray_count, nullptr, 0,
                to_arrays(read_struct(desc.ray_arrays), desc.ray_count)};
    const auto records = strided<math::Ray>(desc.rays, desc.ray_count, desc.ray_stride,
                                            "rt_query_desc.rays", "rt_query_desc.ray_stride");
    return {desc.ray_count, records.data, records.stride, {}};
}

query::Surfaces to_surfaces(const rt_query_desc& desc, uint64_t count) {
    if (!desc.surfaces) return {};
    if (!desc.hits)
        base::fail(
            base::Code::invalid_argument,
            "rt_query_desc.surfaces is given, but hits is null: they lie beside its records");
    require_bits(desc.surface_fields, RT_SURFACE_ALL, "rt_query_desc.surface_fields");
    const auto records =
        strided<query::Surface>(desc.surfaces, count, desc.surface_stride, "rt_query_desc.surfaces",
                                "rt_query_desc.surface_stride");
    return {records.data, records.stride, desc.surface_fields};
}

query::HitLists to_hit_lists(const rt_query_desc& desc) {
    if (desc.max_hits == 0)
        base::fail(base::Code::invalid_argument,
                   "rt_query_desc.max_hits is 0; RT_QUERY_ALL needs room for a hit");
    if (desc.ray_count > UINT64_MAX / desc.max_hits)
        base::fail(base::Code::limit,
                   "rt_query_desc.ray_count times max_hits is larger than the address space");
    const uint64_t count = desc.ray_count * desc.max_hits;
    const auto hits = strided<query::Hit>(desc.hits, count, desc.result_stride,
                                          "rt_query_desc.hits", "rt_query_desc.result_stride");
    query::Strided<uint32_t> totals{};
    if (desc.total_counts)
        totals = strided<uint32_t>(desc.total_counts, desc.ray_count, 0,
                                   "rt_query_desc.total_counts", "");
    return {hits.data, hits.stride, desc.max_hits, to_counts(desc), to_surfaces(desc, count),
            totals};
}

query::Strided<uint32_t> to_counts(const rt_query_desc& desc) {
    return strided<uint32_t>(desc.hit_counts, desc.ray_count, 0, "rt_query_desc.hit_counts", "");
}

query::Hits to_hits(const rt_query_desc& desc) {
    require_one(desc.hits, desc.hit_arrays, "rt_query_desc.hits", "rt_query_desc.hit_arrays");
    if (!desc.hits) return {nullptr, 0, to_arrays(read_struct(desc.hit_arrays), desc.ray_count)};
    const auto records = strided<query::Hit>(desc.hits, desc.ray_count, desc.result_stride,
                                             "rt_query_desc.hits", "rt_query_desc.result_stride");
    return {records.data, records.stride, {}};
}

query::Strided<uint8_t> to_occluded(const rt_query_desc& desc) {
    return strided<uint8_t>(desc.occluded, desc.ray_count, desc.result_stride,
                            "rt_query_desc.occluded", "rt_query_desc.result_stride");
}

} // namespace peregrine::abi
