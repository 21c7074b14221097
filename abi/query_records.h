#pragma once

#include "check.h"
#include "peregrine/rt.h"
#include "query/marks.h"
#include "query/query.h"
#include "query/resolve.h"
#include "query/shapes.h"

#include <cstddef>

// The engine reads and writes the host's records as its own.
namespace peregrine::abi {

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

static_assert(sizeof(rt_sweep) == sizeof(query::Sweep));
PEREGRINE_SAME_PLACE(rt_sweep, center, query::Sweep, center);
PEREGRINE_SAME_PLACE(rt_sweep, radius, query::Sweep, radius);
PEREGRINE_SAME_PLACE(rt_sweep, axis, query::Sweep, axis);
PEREGRINE_SAME_PLACE(rt_sweep, t_max, query::Sweep, t_max);
PEREGRINE_SAME_PLACE(rt_sweep, direction, query::Sweep, direction);
PEREGRINE_SAME_PLACE(rt_sweep, reserved, query::Sweep, reserved);

static_assert(sizeof(rt_sweep_hit) == sizeof(query::SweepHit));
PEREGRINE_SAME_PLACE(rt_sweep_hit, t, query::SweepHit, t);
PEREGRINE_SAME_PLACE(rt_sweep_hit, point, query::SweepHit, point);
PEREGRINE_SAME_PLACE(rt_sweep_hit, normal, query::SweepHit, normal);
PEREGRINE_SAME_PLACE(rt_sweep_hit, depth, query::SweepHit, depth);
PEREGRINE_SAME_PLACE(rt_sweep_hit, triangle, query::SweepHit, triangle);
PEREGRINE_SAME_PLACE(rt_sweep_hit, mesh, query::SweepHit, mesh);
PEREGRINE_SAME_PLACE(rt_sweep_hit, initial_contact, query::SweepHit, initial_contact);

static_assert(sizeof(rt_shape) == sizeof(query::Shape));
PEREGRINE_SAME_PLACE(rt_shape, center, query::Shape, center);
PEREGRINE_SAME_PLACE(rt_shape, radius, query::Shape, radius);
PEREGRINE_SAME_PLACE(rt_shape, extent, query::Shape, extent);
PEREGRINE_SAME_PLACE(rt_shape, kind, query::Shape, kind);
PEREGRINE_SAME_PLACE(rt_shape, rotation, query::Shape, rotation);

static_assert(sizeof(rt_overlap) == sizeof(query::OverlapHit));
PEREGRINE_SAME_PLACE(rt_overlap, mesh, query::OverlapHit, mesh);
PEREGRINE_SAME_PLACE(rt_overlap, triangle, query::OverlapHit, triangle);
PEREGRINE_SAME_PLACE(rt_overlap, reserved, query::OverlapHit, reserved);

static_assert(sizeof(rt_point) == sizeof(query::Point));
PEREGRINE_SAME_PLACE(rt_point, position, query::Point, position);
PEREGRINE_SAME_PLACE(rt_point, radius, query::Point, radius);

static_assert(sizeof(rt_nearest) == sizeof(query::NearestPoint));
PEREGRINE_SAME_PLACE(rt_nearest, distance, query::NearestPoint, distance);
PEREGRINE_SAME_PLACE(rt_nearest, point, query::NearestPoint, point);
PEREGRINE_SAME_PLACE(rt_nearest, normal, query::NearestPoint, normal);
PEREGRINE_SAME_PLACE(rt_nearest, u, query::NearestPoint, u);
PEREGRINE_SAME_PLACE(rt_nearest, v, query::NearestPoint, v);
PEREGRINE_SAME_PLACE(rt_nearest, triangle, query::NearestPoint, triangle);
PEREGRINE_SAME_PLACE(rt_nearest, mesh, query::NearestPoint, mesh);

static_assert(offsetof(rt_mesh, index) == offsetof(base::Handle, index));
static_assert(offsetof(rt_mesh, generation) == offsetof(base::Handle, generation));
static_assert(RT_NO_TRIANGLE == geometry::kNoTriangle);
static_assert(RT_INVALID_BYTE == query::kInvalidByte && RT_INVALID_COUNT == query::kInvalidCount);

#undef PEREGRINE_SAME_PLACE

[[noreturn, gnu::cold]] void fail_stride(uint32_t stride, size_t size, const char* field);

// The bytes between records of the host; `stride` 0: tightly packed.
template <class Record>
uint32_t require_stride(uint32_t stride, const char* field) {
    if (stride == 0) return sizeof(Record);
    if (stride < sizeof(Record)) [[unlikely]]
        fail_stride(stride, sizeof(Record), field);
    return stride;
}

// An array of the host as records of ours; count > 0. Const or not is the caller's affair.
template <class Record>
query::Strided<Record> strided(const void* data, uint64_t count, uint32_t stride, const char* field,
                               const char* stride_field) {
    stride = require_stride<Record>(stride, stride_field);
    require_pointer(data, field);
    require_addressable(data, count, stride, sizeof(Record), field);
    return {static_cast<std::byte*>(const_cast<void*>(data)), count, stride};
}

} // namespace peregrine::abi
