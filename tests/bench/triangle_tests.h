#pragma once

#include "geometry/intersect.h"

// Tests of a ray and a triangle that others use, for comparison with ours (geometry/intersect.h).
// prepare() does what depends on the ray alone, which traversals do once a ray.
namespace peregrine::bench {

using math::Vec3;

struct Crossing {
    bool hit;
    double t;
};

// Ours.
struct Canonical {
    static geometry::ShearedRay prepare(const math::Ray& ray) { return geometry::shear(ray); }
    static Crossing cross(const geometry::ShearedRay& ray, const Vec3 (&v)[3]) {
        geometry::TriangleHit hit{};
        const bool is_hit = geometry::intersect(ray, v[0], v[1], v[2], hit);
        return {is_hit, double(hit.t)};
    }
};

// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, in float alone: without
// their fall-back to double for edge functions that vanish.
struct Watertight {
    struct Sheared {
        math::Ray ray;
        geometry::Axes axes;
        float sx, sy, sz;
    };
    static Sheared prepare(const math::Ray& ray) {
        const geometry::Axes axes = geometry::axes_of(ray.direction);
        const float sz = 1 / ray.direction[axes.kz];
        return {ray, axes, ray.direction[axes.kx] * sz, ray.direction[axes.ky] * sz, sz};
    }
    static Crossing cross(const Sheared& sheared, const Vec3 (&v)[3]) {
        float x[3], y[3], z[3];
        for (int i = 0; i < 3; ++i) {
            const Vec3 to = v[i] - sheared.ray.origin;
            x[i] = to[sheared.axes.kx] - sheared.sx * to[sheared.axes.kz];
            y[i] = to[sheared.axes.ky] - sheared.sy * to[sheared.axes.kz];
            z[i] = sheared.sz * to[sheared.axes.kz];
        }
        const float a = x[2] * y[1] - y[2] * x[1];
        const float b = x[0] * y[2] - y[0] * x[2];
        const float c = x[1] * y[0] - y[1] * x[0];
        if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return {false, 0};
        const float det = a + b + c;
        if (det == 0) return {false, 0};
        const float t = (a * z[0] + b * z[1] + c * z[2]) / det;
        return {t >= sheared.ray.t_min && t <= sheared.ray.t_max, double(t)};
    }
};

// Moeller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
template <class Real>
struct MoellerTrumbore {
    static const math::Ray& prepare(const math::Ray& ray) { return ray; }
    static Crossing cross(const math::Ray& ray, const Vec3 (&v)[3]) {
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
};

template <class Test>
Crossing cross(const math::Ray& ray, const Vec3 (&v)[3]) {
    return Test::cross(Test::prepare(ray), v);
}

} // namespace peregrine::bench
