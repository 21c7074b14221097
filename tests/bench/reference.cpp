#include "reference.h"

#include <cmath>

namespace peregrine::bench {
namespace {

using math::Vec3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3d to_vec(const float* v) {
    return {double(v[0]), double(v[1]), double(v[2])};
}

Corners<double> relative(const Corners<double>& triangle, const Vec3d& origin) {
    return {{triangle.v[0] - origin, triangle.v[1] - origin, triangle.v[2] - origin}};
}

BoxD around(const Segment& segment, double distance) {
    BoxD box;
    box.extend(segment.from);
    box.extend(segment.to);
    return {box.lower - Vec3d(distance), box.upper + Vec3d(distance)};
}

// When a capsule that starts at the origin and moves along `direction` touches the triangle. The
// distance of two convex sets is a convex function of time, so a Newton step from before the root
// never jumps past it, and once the distance no longer falls there is no root.
double impact(const Vec3d& axis, double radius, const Vec3d& direction,
              const Corners<double>& triangle, double t_max) {
    constexpr int kSteps = 200; // a graze halves its error in each, anything else squares it
    double size = radius;
    for (const Vec3d& v : triangle.v) size = std::max(size, glm::length(v));
    const double enough = 1e-15 * size;
    double t = 0;
    for (int step = 0; step < kSteps && t <= t_max; ++step) {
        const Vec3d center = t * direction;
        const Pair pair = nearest_pair({center - axis, center + axis}, triangle);
        const double distance = std::sqrt(pair.squared), gap = distance - radius;
        if (gap <= enough) return t;
        const double slope = glm::dot(pair.a - pair.b, direction) / distance;
        if (slope >= 0) return kInfinity;
        const double next = t - gap / slope;
        if (next == t) return t;
        t = next;
    }
    return t <= t_max ? t : kInfinity;
}

// Whether a point on the triangle lies further along the ray by more than ten times the distance
// that the ray is moved aside.
bool grazes(const Vec3d& direction, const Corners<double>& triangle) {
    const Vec3d n = triangle.normal();
    return std::fabs(glm::dot(n, direction)) < 0.1 * glm::length(n) * glm::length(direction);
}

// Separating axes of a box around the origin and a triangle in the box's frame.
bool box_meets(const Vec3d& extent, const Corners<double>& triangle) {
    const auto separates = [&](const Vec3d& axis) {
        double lower = kInfinity, upper = -kInfinity;
        for (const Vec3d& v : triangle.v) {
            const double x = glm::dot(v, axis);
            lower = std::min(lower, x);
            upper = std::max(upper, x);
        }
        const double reach = glm::dot(extent, glm::abs(axis));
        return lower > reach || upper < -reach;
    };
    if (separates(triangle.normal())) return false;
    for (int k = 0; k < 3; ++k) {
        Vec3d unit(0);
        unit[k] = 1;
        if (separates(unit)) return false;
        for (int i = 0; i < 3; ++i)
            if (separates(glm::cross(unit, triangle.v[(i + 1) % 3] - triangle.v[i]))) return false;
    }
    return true;
}

// The inverse rotation by a quaternion x, y, z, w of any length.
Vec3d rotate_back(const float* quaternion, const Vec3d& v) {
    const Vec3d q = to_vec(quaternion);
    const double w = double(quaternion[3]), square = glm::dot(q, q) + w * w;
    return ((w * w - glm::dot(q, q)) * v + 2 * glm::dot(q, v) * q - 2 * w * glm::cross(q, v))
           / square;
}

} // namespace

Reference::Reference(std::span<const geometry::Triangle> triangles, double band)
    : tree_(triangles), band_(band) {}

Reference::Ray Reference::widen(const rt_ray& ray) {
    const Vec3d direction = to_vec(ray.direction);
    return {to_vec(ray.origin), direction, double(ray.t_max), glm::length(direction)};
}

double Reference::hit(const Ray& ray, const Corners<double>& triangle) const {
    const Corners<double> seen = relative(triangle, ray.origin);
    const Vec3d n = seen.normal();
    const double slope = glm::dot(n, ray.direction);
    if (slope == 0) return kInfinity;
    const double t = glm::dot(n, seen.v[0]) / slope;
    if (!(t >= 0) || t > ray.t_max) return kInfinity;
    for (int i = 0; i < 3; ++i) // volumes of the ray with the edges: all of one sign
        if (glm::dot(ray.direction, glm::cross(seen.v[i], seen.v[(i + 1) % 3])) * slope < 0)
            return kInfinity;
    return t;
}

// Seen along the ray, the triangle's edges keep their distance from it.
bool Reference::is_certain(const Ray& ray, const Corners<double>& triangle, double t) const {
    const double inset = band_ / ray.length;
    if (!(t >= inset) || t > ray.t_max - inset) return false;
    Corners<double> seen = relative(triangle, ray.origin);
    const Vec3d unit = ray.direction / ray.length;
    for (Vec3d& v : seen.v) v -= glm::dot(v, unit) * unit;
    for (int i = 0; i < 3; ++i)
        if (glm::length(nearest_on_segment(Vec3d(0), seen.v[i], seen.v[(i + 1) % 3])) <= band_)
            return false;
    return true;
}

double Reference::first_hit(const rt_ray& ray) const {
    const Ray way = widen(ray);
    double t_max = way.t_max, best = kInfinity;
    tree_.visit_along(way.origin, way.direction, Vec3d(0), t_max, [&](uint32_t i) {
        const double t = hit(way, tree_.corners(i));
        if (t < best) best = t_max = t;
    });
    return best;
}

Contact Reference::judge_hit(const rt_ray& ray) const {
    const Ray way = widen(ray);
    Contact contact{kInfinity, first_hit(ray), kInfinity};
    double t_max = way.t_max;
    tree_.visit_along(way.origin, way.direction, Vec3d(0), t_max, [&](uint32_t i) {
        const double t = hit(way, tree_.corners(i));
        if (t < contact.latest && is_certain(way, tree_.corners(i), t)) contact.latest = t_max = t;
    });
    Ray longer = way;
    longer.t_max += band_ / way.length;
    contact.earliest = time_of_impact({way.origin, Vec3d(0), band_}, longer);
    return contact;
}

double Reference::time_of_impact(const Capsule& capsule, const Ray& way) const {
    double t_max = way.t_max, best = kInfinity;
    const Vec3d pad = glm::abs(capsule.axis) + capsule.radius;
    tree_.visit_along(capsule.center, way.direction, pad, t_max, [&](uint32_t i) {
        const double t = impact(capsule.axis, capsule.radius, way.direction,
                                relative(tree_.corners(i), capsule.center), t_max);
        if (t < best) best = t_max = t;
    });
    return best;
}

Contact Reference::judge_sweep(const rt_sweep& sweep) const {
    const Vec3d direction = to_vec(sweep.direction);
    const double length = glm::length(direction);
    const auto contact = [&](double growth) {
        const Capsule capsule{to_vec(sweep.center), to_vec(sweep.axis),
                              double(sweep.radius) + growth};
        return time_of_impact(
            capsule, {capsule.center, direction, double(sweep.t_max) + growth / length, length});
    };
    return {contact(band_), contact(0), contact(-band_)};
}

double Reference::distance(const Segment& segment, double limit) const {
    double best = kInfinity;
    tree_.visit_within(around(segment, limit), [&](uint32_t i) {
        best = std::min(best, nearest_pair(segment, tree_.corners(i)).squared);
    });
    best = std::sqrt(best);
    return best <= limit ? best : kInfinity;
}

Contact Reference::judge_nearest(const rt_point& point) const {
    const Vec3d p = to_vec(point.position);
    const double limit = double(point.radius) + band_;
    const double d = distance({p, p}, limit);
    const auto within = [&](double radius) { return d <= radius ? d : kInfinity; };
    return {d, within(double(point.radius)), within(double(point.radius) - band_)};
}

Truth Reference::judge_sight(const rt_ray& ray) const {
    const Contact contact = judge_hit(ray);
    if (std::isfinite(contact.latest)) return Truth::yes;
    return std::isfinite(contact.earliest) ? Truth::open : Truth::no;
}

bool Reference::overlaps(const rt_shape& shape, double growth) const {
    const Vec3d center = to_vec(shape.center), extent = to_vec(shape.extent);
    if (shape.kind != RT_SHAPE_BOX) {
        const Vec3d axis = shape.kind == RT_SHAPE_CAPSULE ? extent : Vec3d(0);
        return std::isfinite(
            distance({center - axis, center + axis}, double(shape.radius) + growth));
    }
    bool found = false;
    const Vec3d half = extent + growth;
    tree_.visit_within(around({center, center}, glm::length(half)), [&](uint32_t i) {
        if (found) return;
        Corners<double> triangle = relative(tree_.corners(i), center);
        for (Vec3d& v : triangle.v) v = rotate_back(shape.rotation, v);
        found = box_meets(half, triangle);
    });
    return found;
}

Truth Reference::judge_overlap(const rt_shape& shape) const {
    if (overlaps(shape, -band_)) return Truth::yes;
    return overlaps(shape, band_) ? Truth::open : Truth::no;
}

bool Reference::judge_crossings(const rt_ray& ray, std::vector<double>& t) const {
    const Ray way = widen(ray);
    const double further = way.t_max + band_ / way.length;
    bool certain = true;
    t.clear();
    tree_.visit_along(way.origin, way.direction, Vec3d(band_), further, [&](uint32_t i) {
        const double at = hit(way, tree_.corners(i));
        if (is_certain(way, tree_.corners(i), at) && !grazes(way.direction, tree_.corners(i)))
            t.push_back(at);
        else if (std::isfinite(impact(Vec3d(0), band_, way.direction,
                                      relative(tree_.corners(i), way.origin), further)))
            certain = false;
    });
    std::sort(t.begin(), t.end());
    return certain;
}

} // namespace peregrine::bench
