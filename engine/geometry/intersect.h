#pragma once

#include "geometry/triangle.h"
#include "math/ray.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// THE ray/triangle test: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013.
// Every kernel gives the bits of this file; docs/exact.md tells the whole argument.
//
// Order of operations, e = 2^-24, no contraction into FMA:
//   1. kz is the axis of the largest |direction| (ties: the smaller axis); kx, ky follow
//   cyclically.
//   2. sx = d[kx] / d[kz], sy = d[ky] / d[kz], in float.
//   3. For each vertex V: A = V - origin; Ax = A[kx] - sx * A[kz]; Ay = A[ky] - sy * A[kz], in
//   float.
//   4. U = Cx By - Cy Bx, V = Ax Cy - Ay Cx, W = Bx Ay - By Ax, in double. A product of two floats
//      is exact in double, so each difference has a relative error of 2^-53 and the exact sign.
//   5. Hit if U, V, W are all >= 0 or all <= 0, and det = (U + V) + W is not 0.
//   6. r = 1 / (det d[kz]); t = ((U Az + V Bz) + W Cz) r, u = (V d[kz]) r, v = (W d[kz]) r, in
//      double, then rounded to float. Hit if t_min <= t <= t_max and t is finite. (Nothing here
//      overflows a double: vertices and origins are below 2e30.)
//
// Watertight: two triangles that share an edge round its vertices alike and compute its edge
// function with the operands swapped, which negates it exactly. So a ray cannot pass between them.
//
// Accurate: step 3 moves a vertex by at most 6 e D across the ray and e D along it, D being the
// largest |V - origin|_inf. Steps 4 to 6 lose nothing beyond the rounding of t. Hence the theorem
// that every traversal relies on: *if a triangle is hit at t, then the point origin + t direction
// is closer than 8.1 e D (in the maximum norm) to a point of the triangle.*
namespace peregrine::geometry {

// The part of the test that depends on the ray alone.
struct ShearedRay {
    Vec3 origin;
    float sx, sy;
    double dz;
    int32_t kx, ky, kz;
    float t_min, t_max;
};

// Step 1.
struct Axes {
    int32_t kx, ky, kz;
};
inline Axes axes_of(const Vec3& direction) {
    const float x = std::fabs(direction.x);
    const float y = std::fabs(direction.y);
    const float z = std::fabs(direction.z);
    const int32_t kz = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    const int32_t kx = kz == 2 ? 0 : kz + 1;
    return {kx, kx == 2 ? 0 : kx + 1, kz};
}

inline ShearedRay shear(const math::Ray& ray) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    const auto [kx, ky, kz] = axes_of(ray.direction);
    const float dz = ray.direction[kz];
    return {ray.origin,
            ray.direction[kx] / dz,
            ray.direction[ky] / dz,
            double(dz),
            kx,
            ky,
            kz,
            std::max(ray.t_min, -kLargest),
            std::fmin(ray.t_max, kLargest)};
}

struct TriangleHit {
    float t, u, v;
    bool back_face; // seen from its clockwise side
};

// The exact answer for one ray and one triangle, with [t_min, t_max] as in `ray`.
inline bool intersect(const ShearedRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2,
                      TriangleHit& hit) {
    const Vec3 a = v0 - ray.origin;
    const Vec3 b = v1 - ray.origin;
    const Vec3 c = v2 - ray.origin;
    const float az = a[ray.kz], bz = b[ray.kz], cz = c[ray.kz];
    const float ax = a[ray.kx] - ray.sx * az, ay = a[ray.ky] - ray.sy * az;
    const float bx = b[ray.kx] - ray.sx * bz, by = b[ray.ky] - ray.sy * bz;
    const float cx = c[ray.kx] - ray.sx * cz, cy = c[ray.ky] - ray.sy * cz;

    // A filter that changes nothing: rounding is monotone, so a float edge function that is not 0
    // has the sign of the exact one. 0 and NaN (from overflow) fall through to the doubles.
    const float fu = cx * by - cy * bx;
    const float fv = ax * cy - ay * cx;
    const float fw = bx * ay - by * ax;
    if ((fu < 0 || fv < 0 || fw < 0) && (fu > 0 || fv > 0 || fw > 0)) return false;

    const double u = double(cx) * double(by) - double(cy) * double(bx);
    const double v = double(ax) * double(cy) - double(ay) * double(cx);
    const double w = double(bx) * double(ay) - double(by) * double(ax);
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    const double det = (u + v) + w;
    if (det == 0) return false;

    const double depth = (u * double(az) + v * double(bz)) + w * double(cz);
    const double r = 1 / (det * ray.dz);
    const float t = float(depth * r);
    if (!(t >= ray.t_min && t <= ray.t_max)) return false;
    hit = {t, float((v * ray.dz) * r), float((w * ray.dz) * r), (det > 0) != (ray.dz > 0)};
    return true;
}

} // namespace peregrine::geometry
