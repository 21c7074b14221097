#include "query/query.h"

#include "check.h"
#include "guard.h"
#include "query/resolve.h"
#include "read_struct.h"
#include "scene_table.h"

#include <cstddef>
#include <cstring>

namespace peregrine::abi {
namespace {

using query::Strided;

// The engine reads and writes the host's records as its own.
#define PEREGRINE_SAME_PLACE(HOST, FIELD, OURS, MEMBER)                                            \
    static_assert(offsetof(HOST, FIELD) == offsetof(OURS, MEMBER)                                  \
                  && sizeof(HOST::FIELD) == sizeof(OURS::MEMBER))

static_assert(sizeof(rt_ray) == sizeof(math::Ray));
PEREGRINE_SAME_PLACE(rt_ray, origin, math::Ray, origin);
PEREGRINE_SAME_PLACE(rt_ray, t_min, math::Ray, t_min);
PEREGRINE_SAME_PLACE(rt_ray, direction, math::Ray, direction);
PEREGRINE_SAME_PLACE(rt_ray, t_max, math::Ray, t_max);

static_assert(sizeof(rt_hit) == sizeof(query::Hit));
PEREGRINE_SAME_PLACE(rt_hit, t, query::Hit, t);
PEREGRINE_SAME_PLACE(rt_hit, u, query::Hit, u);
PEREGRINE_SAME_PLACE(rt_hit, v, query::Hit, v);
PEREGRINE_SAME_PLACE(rt_hit, triangle, query::Hit, triangle);
PEREGRINE_SAME_PLACE(rt_hit, mesh, query::Hit, mesh);
PEREGRINE_SAME_PLACE(rt_hit, instance, query::Hit, instance);
PEREGRINE_SAME_PLACE(rt_hit, back_face, query::Hit, back_face);

static_assert(sizeof(rt_surface) == sizeof(query::Surface));
PEREGRINE_SAME_PLACE(rt_surface, position, query::Surface, position);
PEREGRINE_SAME_PLACE(rt_surface, geometric_normal, query::Surface, geometric_normal);
PEREGRINE_SAME_PLACE(rt_surface, shading_normal, query::Surface, shading_normal);
PEREGRINE_SAME_PLACE(rt_surface, texcoord, query::Surface, texcoord);
PEREGRINE_SAME_PLACE(rt_surface, material, query::Surface, material);
PEREGRINE_SAME_PLACE(rt_surface, material_user_data, query::Surface, material_user_data);
PEREGRINE_SAME_PLACE(rt_surface, mesh_user_data, query::Surface, mesh_user_data);

static_assert(offsetof(rt_mesh, index) == offsetof(base::Handle, index));
static_assert(offsetof(rt_mesh, generation) == offsetof(base::Handle, generation));
static_assert(RT_NO_TRIANGLE == geometry::kNoTriangle);

#undef PEREGRINE_SAME_PLACE

[[gnu::cold, noreturn]] void fail_stride(uint32_t stride, size_t size, const char* field) {
    base::fail(base::Code::invalid_argument, "%s is %u, but a record has %zu bytes", field, stride,
               size);
}

// An array of the host as records of ours; count > 0. Const or not is the caller's affair.
template <class Record>
Strided<Record> strided(const void* data, uint64_t count, uint32_t stride, const char* field,
                        const char* stride_field) {
    if (stride == 0) stride = sizeof(Record);
    if (stride < sizeof(Record)) [[unlikely]]
        fail_stride(stride, sizeof(Record), stride_field);
    if (!data) [[unlikely]]
        require_pointer(data, field);
    if (count > 1) require_addressable(data, count, stride, sizeof(Record), field);
    return {static_cast<std::byte*>(const_cast<void*>(data)), count, stride};
}

[[gnu::cold, noreturn]] void fail_selection(const rt_query_desc& desc) {
    require_enum(desc.kind, RT_QUERY_ANY, "rt_query_desc.kind");
    require_enum(desc.faces, RT_FACES_BACK, "rt_query_desc.faces");
    require_zero(desc.reserved, "rt_query_desc.reserved");
    base::fail(base::Code::invalid_argument, "rt_query_desc.flags is %#x; the known bits are %#x",
               desc.flags, unsigned(RT_QUERY_ALPHA_TEST));
}

query::Selection to_selection(const rt_query_desc& desc) {
    const bool known =
        (uint32_t(desc.kind) <= RT_QUERY_ANY) & (uint32_t(desc.faces) <= RT_FACES_BACK)
        & ((desc.flags & ~uint32_t(RT_QUERY_ALPHA_TEST)) == 0) & (desc.reserved == 0);
    if (!known) [[unlikely]]
        fail_selection(desc);
    query::Selection selection;
    selection.faces = trace::Faces(desc.faces);
    selection.layer_mask = desc.layer_mask;
    selection.ignore_mesh = to_handle(desc.ignore_mesh);
    selection.alpha_test = (desc.flags & RT_QUERY_ALPHA_TEST) != 0;
    return selection;
}

[[gnu::cold, noreturn]] void fail_not_committed() {
    base::fail(base::Code::not_committed, "the scene has no snapshot yet: call rt_commit_scene");
}

const scene::Snapshot& require_snapshot(const scene::SnapshotStore::Pin& pin) {
    if (!pin.get()) [[unlikely]]
        fail_not_committed();
    return *pin.get();
}

// One ray, everything visible, nothing unusual: what most calls from gameplay code are.
bool is_plain(const rt_query_desc& desc) {
    const uint32_t unusual = uint32_t(desc.faces) | desc.flags | desc.reserved | ~desc.layer_mask
                             | desc.ignore_mesh.generation | desc.ray_stride | desc.result_stride;
    return desc.ray_count == 1 && unusual == 0;
}

// False: ask the long way, which also finds the words for what is wrong.
bool trace_plain(const HostScene& host, const rt_query_desc& desc) {
    if (!is_plain(desc) || !desc.rays) return false;
    const bool closest = desc.kind == RT_QUERY_CLOSEST && desc.hits;
    if (!closest && !(desc.kind == RT_QUERY_ANY && desc.occluded)) return false;
    const scene::SnapshotStore::Pin pin(host.scene.snapshots);
    if (!pin.get()) return false;
    math::Ray ray;
    std::memcpy(&ray, desc.rays, sizeof ray);
    query::check_ray(ray);
    if (closest) {
        query::closest_hit(*pin.get(), ray, reinterpret_cast<std::byte*>(desc.hits));
    } else {
        *desc.occluded = query::occluded(*pin.get(), ray);
    }
    return true;
}

// Apart from the short way, so that its registers and stack cost that one nothing.
[[gnu::noinline]] void trace_any(const HostScene& host, const rt_query_desc& desc) {
    const query::Selection selection = to_selection(desc);
    if (desc.ray_count == 0) return;
    const auto rays = strided<math::Ray>(desc.rays, desc.ray_count, desc.ray_stride,
                                         "rt_query_desc.rays", "rt_query_desc.ray_stride");
    if (desc.kind == RT_QUERY_CLOSEST) {
        const auto hits = strided<query::Hit>(desc.hits, desc.ray_count, desc.result_stride,
                                              "rt_query_desc.hits", "rt_query_desc.result_stride");
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        const scene::Snapshot& snapshot = require_snapshot(pin);
        query::check_rays(rays);
        query::closest_hits(snapshot, rays, selection, hits);
    } else {
        const auto occluded =
            strided<uint8_t>(desc.occluded, desc.ray_count, desc.result_stride,
                             "rt_query_desc.occluded", "rt_query_desc.result_stride");
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        const scene::Snapshot& snapshot = require_snapshot(pin);
        query::check_rays(rays);
        query::occlusion(snapshot, rays, selection, occluded);
    }
}

[[gnu::noinline]] void trace_read(const HostScene& host, const rt_query_desc* desc) {
    trace_any(host, read_struct(desc));
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_trace_query(rt_scene scene, const rt_query_desc* desc) noexcept {
    return guard([&] {
        const HostScene& host = find_scene(scene);
        if (!desc || desc->struct_size != sizeof *desc) [[unlikely]]
            trace_read(host, desc);
        else if (!trace_plain(host, *desc))
            trace_any(host, *desc);
    });
}

rt_result rt_resolve_hits(rt_scene scene, const rt_hit* hits, uint64_t count, uint32_t hit_stride,
                          rt_surface* out_surfaces, uint32_t surface_stride) noexcept {
    return guard([&] {
        const HostScene& host = find_scene(scene);
        if (count == 0) return;
        const auto in = strided<query::Hit>(hits, count, hit_stride, "hits", "hit_stride");
        const auto out = strided<query::Surface>(out_surfaces, count, surface_stride,
                                                 "out_surfaces", "surface_stride");
        const scene::SnapshotStore::Pin pin(host.scene.snapshots);
        query::resolve(require_snapshot(pin), in, out);
    });
}
