#pragma once

#include "geometry/shapes/overlap.h"
#include "query/query.h"
#include "query/records.h"
#include "scene/snapshot.h"

#include <cstdint>

// Spheres, capsules and boxes against the triangles of a snapshot.
namespace peregrine::query {

// A capsule, the points within `radius` of the segment center - axis to center + axis, that moves
// by t * direction, 0 <= t <= t_max. Axis 0: a sphere. The layout of rt_sweep.
struct Sweep {
    math::Vec3 center;
    float radius;
    math::Vec3 axis;
    float t_max; // may be infinite; below 0: an empty way
    math::Vec3 direction;
    uint32_t reserved; // 0
};
static_assert(sizeof(Sweep) == 48);

// The first contact; of initial ones the deepest. The layout of rt_sweep_hit.
struct SweepHit {
    float t;           // infinity: none
    math::Vec3 point;  // of the triangle
    math::Vec3 normal; // unit, from the triangle towards the shape
    float depth;       // radius less distance, if they touch at the start
    uint32_t triangle; // the host's own index; kNoTriangle for none
    base::Handle mesh;
    uint32_t initial_contact;
};
static_assert(sizeof(SweepHit) == 48);

// The layout of rt_shape.
struct Shape {
    enum Kind : uint32_t { sphere = 0, capsule = 1, box = 2 };

    math::Vec3 center;
    float radius;      // of spheres and capsules
    math::Vec3 extent; // half the axis of a capsule, half the sizes of a box
    uint32_t kind;
    float rotation[4]; // of a box: a quaternion x, y, z, w of any length
};
static_assert(sizeof(Shape) == 48);

// The layout of rt_overlap.
struct OverlapHit {
    base::Handle mesh;
    uint32_t triangle; // the host's own index
    uint32_t reserved;
};
static_assert(sizeof(OverlapHit) == 16);

// The layout of rt_point.
struct Point {
    math::Vec3 position;
    float radius; // may be infinite; below 0: nothing is found
};
static_assert(sizeof(Point) == 16);

// The layout of rt_nearest.
struct NearestPoint {
    float distance; // infinity: nothing within the radius
    math::Vec3 point;
    math::Vec3 normal; // unit, towards the query's point; of the front if the distance is 0
    float u, v;
    uint32_t triangle; // the host's own index; kNoTriangle for none
    base::Handle mesh;
};
static_assert(sizeof(NearestPoint) == 48);

inline math::Vec3& place_of(Sweep& sweep) {
    return sweep.center;
}
inline math::Vec3& place_of(Shape& shape) {
    return shape.center;
}
inline math::Vec3& place_of(Point& point) {
    return point.position;
}

// Records that are relative to a point: their own place and this are added in double, and the sum
// is rounded to float.
template <class Record>
struct Placed : Strided<Record> {
    Shift shift{};

    // The record as the snapshot counts positions.
    Record moved(Record record) const {
        if (shift) place_of(record) = shift.applied(place_of(record));
        return record;
    }
};

// Where the triangles go that each shape touches: those of shape i from element i * most on, in
// ascending order of (mesh slot, triangle), no more than `most`. `counts` has them all.
struct OverlapLists {
    std::byte* hits; // may be null if `most` is 0
    uint32_t stride;
    uint32_t most;
    Strided<uint32_t> counts;
};

// What a box fills, around its centre.
geometry::Cuboid cuboid_of(const Shape& box);

// Faces: for sweeps a front is a triangle whose geometric normal points against the direction; for
// the others one that the centre is in front of, or in whose plane it lies.
//
// Throw base::Error invalid_argument that names the first record, and its field, which is out of
// range: NaN, infinite or beyond 1e30; a negative radius or size; a direction or a rotation of 0.
// Ends, t_max and the radius of a point, may be anything but NaN. Nothing is written then. Or they
// mark its results, as query.h says of rays.
void sweep(const scene::Snapshot& snapshot, const Placed<Sweep>& sweeps, const Request& request,
           const Strided<SweepHit>& hits);
void overlap_any(const scene::Snapshot& snapshot, const Placed<Shape>& shapes,
                 const Request& request, const Strided<uint8_t>& overlaps);
void overlap_all(const scene::Snapshot& snapshot, const Placed<Shape>& shapes,
                 const Request& request, const OverlapLists& lists);
void nearest(const scene::Snapshot& snapshot, const Placed<Point>& points, const Request& request,
             const Strided<NearestPoint>& nearest);

} // namespace peregrine::query
