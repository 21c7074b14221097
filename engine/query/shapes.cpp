#include "query/shapes.h"

#include "query/chosen.h"
#include "query/hit_names.h"
#include "query/marks.h"
#include "query/spread.h"
#include "query/total_counters.h"
#include "query/valid_ray.h"
#include "query/valid_shape.h"
#include "trace/world/shapes.h"

namespace peregrine::query {

using math::Vec3;
using math::Vec3d;
using trace::Position;

// Columns of the rotation matrix. Lengths are told from 0 by the largest component, so that none
// vanishes.
geometry::Cuboid cuboid_of(const Shape& shape) {
    double q[4], largest = 0;
    for (const float part : shape.rotation) largest = std::max(largest, double(std::fabs(part)));
    for (int k = 0; k < 4; ++k) q[k] = double(shape.rotation[k]) / largest;
    const double length = std::sqrt(((q[0] * q[0] + q[1] * q[1]) + q[2] * q[2]) + q[3] * q[3]);
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
             {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
             {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}},
            Vec3d(shape.extent)};
}

namespace {

// What a ball around each point of the axis fills.
trace::Volume volume_of(const Vec3& center, const Vec3& direction, const Vec3& axis, float radius) {
    return {Vec3d(center), Vec3d(direction), glm::abs(Vec3d(axis)) + double(radius), Vec3d(axis),
            double(radius)};
}

// What one thread's shapes ask of the host and count.
class Witness {
public:
    Witness(const scene::Snapshot& snapshot, const Request& request)
        : names_(snapshot), accept_(request.selection.accept) {
        if (accept_) {
            watch_.accepts = accepts;
            watch_.context = this;
        }
        if (request.counters) watch_.counters = &counters_;
    }
    Witness(const Witness&) = delete;
    Witness& operator=(const Witness&) = delete;

    void begin_shape(uint64_t index) { index_ = index; }
    // Null: nothing.
    const trace::Watch* watch() const {
        return watch_.accepts || watch_.counters ? &watch_ : nullptr;
    }
    const trace::Counters& counters() const { return counters_; }

private:
    static bool accepts(void* context, uint32_t mesh, uint32_t primitive) {
        const auto& self = *static_cast<const Witness*>(context);
        const Hit candidate = {0, 0, 0, primitive, self.names_.mesh(mesh), 0, 0};
        return self.accept_.ask(self.accept_.user, self.index_, candidate);
    }

    HitNames names_;
    const Accept& accept_;
    trace::Watch watch_;
    trace::Counters counters_;
    uint64_t index_ = 0;
};

struct Prepared {
    trace::OverlapQuery query;
    trace::Volume volume;
};

Prepared prepare(const Shape& shape, const trace::Filter& filter, const trace::Watch* watch) {
    Prepared out;
    out.query.filter = filter;
    out.query.watch = watch;
    out.query.shape.kind = trace::Shape::Kind(shape.kind);
    out.query.shape.center = Vec3d(shape.center);
    if (shape.kind == Shape::box) {
        const geometry::Cuboid box = cuboid_of(shape);
        out.query.shape.cuboid = box;
        out.volume.origin = Vec3d(shape.center);
        out.volume.extent =
            (glm::abs(box.axis[0]) * box.half.x + glm::abs(box.axis[1]) * box.half.y)
            + glm::abs(box.axis[2]) * box.half.z;
        out.volume.radius = std::sqrt(glm::dot(box.half, box.half)) * (1 + 0x1p-40);
        return out;
    }
    const Vec3 axis = shape.kind == Shape::capsule ? shape.extent : Vec3(0);
    if (axis == Vec3(0)) out.query.shape.kind = trace::Shape::sphere;
    out.query.shape.axis = Vec3d(axis);
    out.query.shape.rr = double(shape.radius) * double(shape.radius);
    out.volume = volume_of(shape.center, Vec3(0), axis, shape.radius);
    return out;
}

// `record` is as the host placed it, relative to `base`, and so is the answer.
SweepHit sweep_one(const trace::World& world, const HitNames& names, const Sweep& record,
                   const math::Vec3d& base, const Sweep& sweep, const trace::Filter& filter,
                   bool slides, const trace::Watch* watch) {
    if (!(sweep.t_max >= 0)) return no_contact(kInfinity);
    const trace::SweepQuery query{{sweep.center, sweep.axis, sweep.direction, sweep.radius},
                                  filter,
                                  std::min(sweep.t_max, kLargestFloat),
                                  watch};
    const trace::Volume volume = volume_of(sweep.center, sweep.direction, sweep.axis, sweep.radius);
    const trace::Position position{record.center, base};
    const trace::FirstHit hit = slides ? trace::slide(world, volume, position, query)
                                       : trace::sweep(world, volume, position, query);
    if (hit.triangle == geometry::kNoTriangle) return no_contact(hit.t);
    const HitIds ids = names.of(hit.triangle);
    return {hit.t,
            Vec3(Vec3d(record.center) + hit.contact.point),
            Vec3(hit.contact.normal),
            hit.depth,
            ids.triangle,
            ids.mesh,
            hit.initial};
}

// All that the shape touches, a bufferful at a time.
uint32_t collect(const trace::World& world, const HitNames& names, const Prepared& shape,
                 const Position& position, const OverlapLists& lists, uint64_t index) {
    trace::Touched touched;
    uint32_t count = 0;
    uint64_t first = 0;
    do {
        touched.restart(first);
        trace::collect(world, shape.volume, position, shape.query, touched);
        touched.finish();
        for (const uint64_t key : touched) {
            first = key + 1;
            if (count++ >= lists.most) continue;
            const OverlapHit hit{names.mesh(uint32_t(key >> 32)), uint32_t(key), 0};
            const uint64_t place = index * lists.most + (count - 1);
            std::memcpy(lists.hits + place * lists.stride, &hit, sizeof hit);
        }
    } while (touched.is_full());
    return count;
}

// A radius that is no obstacle: as good as infinite, and no larger than what there is to reach, for
// errors that grow with it.
float radius_within(const trace::World& world, const Point& point) {
    if (point.radius <= 0x1p20f || world.bounds.empty()) return point.radius;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
        const float farthest =
            std::max(std::fabs(world.bounds.lower[k]), std::fabs(world.bounds.upper[k]));
        const double side = double(farthest) + std::fabs(double(point.position[k]));
        square += side * side;
    }
    const double twice = std::min(2 * std::sqrt(square), double(kLargestFloat));
    return std::min(point.radius, float(twice));
}

NearestPoint nearest_one(const trace::World& world, const HitNames& names, const Point& record,
                         const math::Vec3d& base, const Point& point, const trace::Filter& filter,
                         const trace::Watch* watch) {
    if (!(point.radius >= 0)) return no_point(kInfinity);
    const float radius = radius_within(world, point);
    const trace::NearestQuery query{Vec3d(point.position), filter, radius, watch};
    const trace::NearestHit hit = trace::nearest(
        world, volume_of(point.position, Vec3(0), Vec3(0), radius), {record.position, base}, query);
    if (hit.triangle == geometry::kNoTriangle) return no_point(hit.distance);
    const HitIds ids = names.of(hit.triangle);
    return {hit.distance,
            Vec3(Vec3d(record.position) + hit.at),
            Vec3(hit.normal),
            hit.u,
            hit.v,
            ids.triangle,
            ids.mesh};
}

// Calls work(i, record i, filter, watch) for all of them, or mark(i) for those that are not valid.
template <class Record, class Work, class Mark>
void for_each(const scene::Snapshot& snapshot, const Placed<Record>& records,
              const Request& request, Work&& work, Mark&& mark) {
    const bool marks = request.mark_invalid;
    if (!marks) check_each(records);
    const Chosen chosen(snapshot, request.selection);
    TotalCounters total;
    spread(request.selection.accept ? nullptr : request.scheduler, records.count,
           [&](uint64_t first, uint64_t end) {
               Witness witness(snapshot, request);
               for (uint64_t i = first; i < end; ++i) {
                   const Record record = records.load(i);
                   if (marks && !is_valid(records, record)) [[unlikely]] {
                       mark(i);
                       continue;
                   }
                   witness.begin_shape(i);
                   work(i, record, chosen.filter(), witness.watch());
               }
               if (request.counters) total.add(witness.counters());
           });
    if (request.counters) *request.counters += total.get();
}

using Filter = trace::Filter;
using Watch = trace::Watch;

} // namespace

void sweep(const scene::Snapshot& snapshot, const Placed<Sweep>& sweeps, const Request& request,
           const Strided<SweepHit>& hits) {
    const HitNames names(snapshot);
    const bool slides = request.selection.skip_separating;
    for_each(
        snapshot, sweeps, request,
        [&](uint64_t i, const Sweep& sweep, const Filter& filter, const Watch* watch) {
            hits.store(i, sweep_one(snapshot.world, names, sweep, sweeps.shift.by,
                                    sweeps.moved(sweep), filter, slides, watch));
        },
        [&](uint64_t i) { hits.store(i, no_contact(kNotANumber)); });
}

void overlap_any(const scene::Snapshot& snapshot, const Placed<Shape>& shapes,
                 const Request& request, const Strided<uint8_t>& overlaps) {
    for_each(
        snapshot, shapes, request,
        [&](uint64_t i, const Shape& shape, const Filter& filter, const Watch* watch) {
            const Prepared prepared = prepare(shapes.moved(shape), filter, watch);
            overlaps.store(i, trace::overlaps(snapshot.world, prepared.volume,
                                              Position{shape.center, shapes.shift.by},
                                              prepared.query));
        },
        [&](uint64_t i) { overlaps.store(i, kInvalidByte); });
}

void overlap_all(const scene::Snapshot& snapshot, const Placed<Shape>& shapes,
                 const Request& request, const OverlapLists& lists) {
    const HitNames names(snapshot);
    for_each(
        snapshot, shapes, request,
        [&](uint64_t i, const Shape& shape, const Filter& filter, const Watch* watch) {
            const Prepared prepared = prepare(shapes.moved(shape), filter, watch);
            lists.counts.store(i, collect(snapshot.world, names, prepared,
                                          {shape.center, shapes.shift.by}, lists, i));
        },
        [&](uint64_t i) { lists.counts.store(i, kInvalidCount); });
}

void nearest(const scene::Snapshot& snapshot, const Placed<Point>& points, const Request& request,
             const Strided<NearestPoint>& nearest) {
    const HitNames names(snapshot);
    for_each(
        snapshot, points, request,
        [&](uint64_t i, const Point& point, const Filter& filter, const Watch* watch) {
            nearest.store(i, nearest_one(snapshot.world, names, point, points.shift.by,
                                         points.moved(point), filter, watch));
        },
        [&](uint64_t i) { nearest.store(i, no_point(kNotANumber)); });
}

} // namespace peregrine::query
