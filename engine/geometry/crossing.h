#pragma once

#include "geometry/intersect.h"

// Which of the triangles that a ray hits it also crosses. Where the ray goes from one side of a
// surface to the other, it crosses exactly one.
//
// A ray through a shared edge hits both triangles (that is what makes them watertight), one through
// a vertex all of those around it. To follow a ray in and out of closed surfaces, it is moved by an
// infinitesimal vector, the same for all triangles: a symbolic perturbation (Edelsbrunner, Mücke,
// "Simulation of Simplicity", ACM TOG 1990), known from rasterisers as the top-left rule. In the
// plane of step 3 of intersect.h the ray is the origin; it is moved to (e, e^2), with e > 0 smaller
// than any number. The edge function of the vertices P and Q,
//     P x Q = Px Qy - Py Qx,
// becomes (P - (e, e^2)) x (Q - (e, e^2)) = P x Q + e (Py - Qy) + e^2 (Qx - Px). P x Q has its
// exact sign in double; where it is 0, Py - Qy decides, then Qx - Px: comparisons of floats, exact
// too, and all of them change sign if P and Q are swapped. A triangle is crossed if it is hit and
// its three signs agree.
//
// The projected vertices are what they are, rounded to float, but the same for every triangle that
// has them. So a closed mesh is a closed polyhedron in this plane, and the moved origin, which lies
// on no line through two of its vertices, sees each piece of it from one side: among the triangles
// crossed along the whole line there are as many fronts as backs, always. A triangle seen edge-on,
// whose projected vertices lie on a line, is not crossed: its three functions sum to its area, 0,
// so they cannot agree.
namespace peregrine::geometry {

struct Projected {
    float x, y;
};

// Step 3 of intersect.h, in its order of operations.
inline Projected project(const ShearedRay& ray, const Vec3& vertex) {
    const Vec3 v = vertex - ray.origin;
    const float z = v[ray.kz];
    return {v[ray.kx] - ray.sx * z, v[ray.ky] - ray.sy * z};
}

// The sign of the moved edge function; 0 only where the vertices are one point.
inline int edge_sign(const Projected& p, const Projected& q) {
    const double edge = double(p.x) * double(q.y) - double(p.y) * double(q.x);
    if (edge != 0) return edge > 0 ? 1 : -1;
    if (p.y != q.y) return p.y > q.y ? 1 : -1;
    return int(q.x > p.x) - int(q.x < p.x);
}

// Whether a triangle that the ray hits, by intersect(), is crossed.
inline bool is_crossed(const ShearedRay& ray, const Vec3& v0, const Vec3& v1, const Vec3& v2) {
    const Projected a = project(ray, v0), b = project(ray, v1), c = project(ray, v2);
    const int u = edge_sign(c, b), v = edge_sign(a, c), w = edge_sign(b, a);
    return u != 0 && u == v && v == w;
}

} // namespace peregrine::geometry
