#pragma once

#include "geometry/intersect.h"

// Tests of a ray and a triangle that others use, for comparison with ours (geometry/intersect.h).
namespace peregrine::bench {

using math::Vec3;

struct Crossing {
    bool hit;
    double t;
};

// Ours.
inline Crossing test_canonical(const math::Ray& ray, const Vec3 (&v)[3]) {
    geometry::TriangleHit hit{};
    const bool is_hit = geometry::intersect(geometry::shear(ray), v[0], v[1], v[2], hit);
    return {is_hit, double(hit.t)};
}

// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, in float alone: without
// their fall-back to double for edge functions that vanish.
inline Crossing test_watertight(const math::Ray& ray, const Vec3 (&v)[3]) {
    const auto [kx, ky, kz] = geometry::axes_of(ray.direction);
    const float sz = 1 / ray.direction[kz];
    const float sx = ray.direction[kx] * sz, sy = ray.direction[ky] * sz;
    float x[3], y[3], z[3];
    for (int i = 0; i < 3; ++i) {
        const Vec3 to = v[i] - ray.origin;
        x[i] = to[kx] - sx * to[kz];
        y[i] = to[ky] - sy * to[kz];
        z[i] = sz * to[kz];
    }
    const float a = x[2] * y[1] - y[2] * x[1];
    const float b = x[0] * y[2] - y[0] * x[2];
    const float c = x[1] * y[0] - y[1] * x[0];
    if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return {false, 0};
    const float det = a + b + c;
    if (det == 0) return {false, 0};
    const float t = (a * z[0] + b * z[1] + c * z[2]) / det;
    return {t >= ray.t_min && t <= ray.t_max, double(t)};
}

// Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
template <class Real>
Crossing test_moeller_trumbore(const math::Ray& ray, const Vec3 (&v)[3]) {
    using Vector = glm::vec<3, Real>;
    const Vector origin(ray.origin), direction(ray.direction), first(v[0]);
    const Vector e1 = Vector(v[1]) - first, e2 = Vector(v[2]) - first;
    const Vector p = glm::cross(direction, e2);
    const Real det = glm::dot(e1, p);
    if (det == 0) return {false, 0};
    const Real inverse = 1 / det;
    const Vector s = origin - first;
    const Real u = glm::dot(s, p) * inverse;
    if (!(u >= 0 && u <= 1)) return {false, 0};
    const Vector q = glm::cross(s, e1);
    const Real w = glm::dot(direction, q) * inverse;
    if (!(w >= 0 && u + w <= 1)) return {false, 0};
    const Real t = glm::dot(e2, q) * inverse;
    return {t >= Real(ray.t_min) && t <= Real(ray.t_max), double(t)};
}

} // namespace peregrine::bench
