#include "query_set.h"

#include "sampling.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace peregrine::bench {
namespace {

using math::Vec3;

constexpr QueryItem kItems[] = {
    {"sight", QueryKind::any, "line of sight between two random points"},
    {"probe", QueryKind::closest, "closest hit within 5 m below a point"},
    {"batch", QueryKind::stream,
     "closest hit in a random direction, all rays in one call or in\n"
     "the largest batches that a contestant has"},
    {"sphere-0.1", QueryKind::sweep, "a sphere of radius 0.1 m moves by 10% of the diagonal"},
    {"sphere-0.4", QueryKind::sweep, "the same with radius 0.4 m"},
    {"capsule", QueryKind::sweep, "the same, an upright capsule of radius 0.4 and height 1.8 m"},
    {"overlap-sphere", QueryKind::overlap, "does a sphere of radius 0.4 m touch anything?"},
    {"overlap-capsule", QueryKind::overlap, "the same of the capsule"},
    {"overlap-box", QueryKind::overlap, "the same of a turned cube with sides of 0.8 m"},
    {"nearest", QueryKind::nearest, "nearest point of a surface within 1 m"},
    {"all", QueryKind::all,
     "all crossings, 16 at most, in a random direction over 10% of the\n"
     "diagonal"},
};

constexpr size_t kPoints = size_t(1) << 16;
constexpr size_t kTrials = 1000 * kPoints;
constexpr float kProbe = 5, kReach = 1;         // metres
constexpr float kHalfAxis = 0.5f, kWide = 0.4f; // of the capsule
constexpr float kWay = 0.1f;                    // of the diagonal
constexpr double kClear = 0.01;                 // metres around shapes where sweeps start
constexpr float kInfinity = std::numeric_limits<float>::infinity();

rt_ray to_ray(const Vec3& from, const Vec3& direction, float t_max) {
    return {{from.x, from.y, from.z}, 0, {direction.x, direction.y, direction.z}, t_max};
}

// Draws points of the walk, and what else a set needs.
struct Source {
    std::span<const Vec3> points;
    Random random;

    Vec3 point() {
        const size_t i = size_t(random.uniform() * float(points.size()));
        return points[std::min(i, points.size() - 1)];
    }
};

rt_ray make_ray(std::string_view item, Source& source, float way) {
    const Vec3 from = source.point();
    if (item == "probe") return to_ray(from, {0, -1, 0}, kProbe);
    if (item == "batch") return to_ray(from, source.random.direction(), kInfinity);
    if (item == "all") return to_ray(from, source.random.direction(), way);
    Vec3 to = source.point();
    while (to == from) to = source.point();
    return to_ray(from, to - from, 1);
}

// Starts where it touches nothing: what a sweep says of an overlap is each library's own.
rt_sweep make_sweep(std::string_view item, Source& source, float way, const Reference& reference) {
    rt_sweep sweep{};
    sweep.radius = item == "sphere-0.1" ? 0.1f : kWide;
    sweep.axis[1] = item == "capsule" ? kHalfAxis : 0;
    sweep.t_max = way;
    const math::Vec3d axis(0, double(sweep.axis[1]), 0);
    const double room = double(sweep.radius) + kClear;
    for (size_t trial = 0; trial < kTrials; ++trial) {
        const Vec3 p = source.point();
        const math::Vec3d center(p);
        if (std::isfinite(reference.distance({center - axis, center + axis}, room))) continue;
        const Vec3 direction = source.random.direction();
        for (int k = 0; k < 3; ++k) sweep.center[k] = p[k], sweep.direction[k] = direction[k];
        return sweep;
    }
    throw std::runtime_error("no room for a shape of radius " + std::to_string(sweep.radius));
}

rt_shape make_shape(std::string_view item, Source& source) {
    rt_shape shape{};
    const Vec3 p = source.point();
    for (int k = 0; k < 3; ++k) shape.center[k] = p[k];
    if (item == "overlap-box") {
        shape.kind = RT_SHAPE_BOX;
        shape.extent[0] = shape.extent[1] = shape.extent[2] = kWide;
        const Vec3 axis = source.random.direction();
        for (int k = 0; k < 3; ++k) shape.rotation[k] = axis[k];
        shape.rotation[3] = 2 * source.random.uniform() - 1;
        const float length = std::sqrt(1 + shape.rotation[3] * shape.rotation[3]);
        for (float& q : shape.rotation) q /= length;
        return shape;
    }
    shape.radius = kWide;
    shape.kind = item == "overlap-capsule" ? RT_SHAPE_CAPSULE : RT_SHAPE_SPHERE;
    if (shape.kind == RT_SHAPE_CAPSULE) shape.extent[1] = kHalfAxis;
    return shape;
}

template <class Change>
void change_positions(QuerySet& set, const Change& change) {
    for (rt_ray& ray : set.rays) change(ray.origin);
    for (rt_sweep& sweep : set.sweeps) change(sweep.center);
    for (rt_shape& shape : set.shapes) change(shape.center);
    for (rt_point& point : set.points) change(point.position);
}

} // namespace

std::span<const QueryItem> query_items() {
    return kItems;
}

QuerySet moved(QuerySet set, const math::Vec3d& offset) {
    change_positions(set, [&](float* v) {
        for (int k = 0; k < 3; ++k) v[k] = float(double(v[k]) + offset[k]);
    });
    return set;
}

QuerySet scaled(QuerySet set, float scale) {
    const auto stretch = [&](float* v) {
        for (int k = 0; k < 3; ++k) v[k] *= scale;
    };
    change_positions(set, stretch);
    for (rt_ray& ray : set.rays) stretch(ray.direction);
    for (rt_sweep& sweep : set.sweeps) {
        stretch(sweep.direction);
        stretch(sweep.axis);
        sweep.radius *= scale;
    }
    for (rt_shape& shape : set.shapes) {
        stretch(shape.extent);
        shape.radius *= scale;
    }
    for (rt_point& point : set.points) point.radius *= scale;
    return set;
}

QueryMaker::QueryMaker(const TraceScene& scene, const Reference& reference, float way)
    : reference_(reference), way_(way > 0 ? way : kWay * scene.diagonal()) {
    Random random(5);
    for (const host::Viewpoint& camera : scene.cameras)
        points_.push_back(math::Vec3(camera.position));
    const size_t cameras = points_.size();
    for (size_t trial = 0; trial < kTrials && points_.size() < cameras + kPoints; ++trial) {
        const size_t parent = size_t(random.uniform() * float(points_.size()));
        const Vec3 from = points_[std::min(parent, points_.size() - 1)];
        const Vec3 direction = random.direction();
        const double t = reference.first_hit(to_ray(from, direction, kInfinity));
        const float part = 0.98f * random.uniform();
        if (std::isfinite(t)) points_.push_back(from + part * float(t) * direction);
    }
    points_.erase(points_.begin(), points_.begin() + std::ptrdiff_t(cameras));
    if (points_.size() < kPoints)
        throw std::runtime_error(scene.name + ": hardly a ray from its cameras meets anything");
}

QuerySet QueryMaker::make(const QueryItem& item, size_t count) const {
    QuerySet set{item.kind, {}, {}, {}, {}};
    Source source{points_, Random(uint32_t(6 + (&item - kItems)))};
    while (set.size() < count) {
        switch (item.kind) {
        case QueryKind::any:
        case QueryKind::closest:
        case QueryKind::stream:
        case QueryKind::all:
            set.rays.push_back(make_ray(item.name, source, way_));
            break;
        case QueryKind::sweep:
            set.sweeps.push_back(make_sweep(item.name, source, way_, reference_));
            break;
        case QueryKind::overlap:
            set.shapes.push_back(make_shape(item.name, source));
            break;
        case QueryKind::nearest: {
            const Vec3 p = source.point();
            set.points.push_back({{p.x, p.y, p.z}, kReach});
            break;
        }
        }
    }
    return set;
}

} // namespace peregrine::bench
