#pragma once

#include "math/vec.h"

#include <algorithm>
#include <limits>

// Nearest points, the simple way: every candidate is looked at and the best is kept.
namespace peregrine::bench {

template <class T>
using Point = glm::vec<3, T>;

template <class T>
T squared_length(const Point<T>& v) {
    return glm::dot(v, v);
}

template <class T>
Point<T> nearest_on_segment(const Point<T>& p, const Point<T>& a, const Point<T>& b) {
    const Point<T> along = b - a;
    const T length = squared_length(along);
    if (!(length > 0)) return a;
    return a + std::clamp(glm::dot(p - a, along) / length, T(0), T(1)) * along;
}

template <class T>
struct Corners {
    Point<T> v[3];

    Point<T> normal() const { return glm::cross(v[1] - v[0], v[2] - v[0]); } // not unit

    // Whether p, moved along the normal, meets the triangle.
    bool covers(const Point<T>& p) const {
        const Point<T> n = normal();
        for (int i = 0; i < 3; ++i)
            if (glm::dot(n, glm::cross(v[(i + 1) % 3] - v[i], p - v[i])) < 0) return false;
        return squared_length(n) > 0;
    }
};

template <class T>
Point<T> nearest_on_triangle(const Point<T>& p, const Corners<T>& triangle) {
    if (triangle.covers(p)) {
        const Point<T> n = triangle.normal();
        return p - glm::dot(p - triangle.v[0], n) / squared_length(n) * n;
    }
    Point<T> best(0);
    T least = std::numeric_limits<T>::infinity();
    for (int i = 0; i < 3; ++i) {
        const Point<T> q = nearest_on_segment(p, triangle.v[i], triangle.v[(i + 1) % 3]);
        const T distance = squared_length(p - q);
        if (distance < least) least = distance, best = q;
    }
    return best;
}

// A point of one thing and a point of another.
struct Pair {
    math::Vec3d a{0}, b{0};
    double squared = std::numeric_limits<double>::infinity();

    void consider(const math::Vec3d& p, const math::Vec3d& q) {
        const double distance = squared_length(p - q);
        if (distance < squared) *this = {p, q, distance};
    }
};

struct Segment {
    math::Vec3d from, to;
};

inline void consider_segments(const Segment& s, const Segment& e, Pair& best) {
    for (const math::Vec3d& end : {s.from, s.to})
        best.consider(end, nearest_on_segment(end, e.from, e.to));
    for (const math::Vec3d& end : {e.from, e.to})
        best.consider(nearest_on_segment(end, s.from, s.to), end);
    const math::Vec3d u = s.to - s.from, v = e.to - e.from, w = s.from - e.from;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) return; // parallel: the ends have seen it
    const double x = (uv * glm::dot(v, w) - vv * glm::dot(u, w)) / determinant;
    const double y = (uu * glm::dot(v, w) - uv * glm::dot(u, w)) / determinant;
    if (x > 0 && x < 1 && y > 0 && y < 1) best.consider(s.from + x * u, e.from + y * v);
}

// Point `a` is the segment's, `b` the triangle's.
inline Pair nearest_pair(const Segment& segment, const Corners<double>& triangle) {
    Pair best;
    best.consider(segment.from, nearest_on_triangle(segment.from, triangle));
    if (segment.from == segment.to) return best;
    best.consider(segment.to, nearest_on_triangle(segment.to, triangle));
    for (int i = 0; i < 3; ++i)
        consider_segments(segment, {triangle.v[i], triangle.v[(i + 1) % 3]}, best);
    const math::Vec3d n = triangle.normal();
    const double before = glm::dot(segment.from - triangle.v[0], n);
    const double after = glm::dot(segment.to - triangle.v[0], n);
    if (before * after < 0) {
        const math::Vec3d p =
            segment.from + before / (before - after) * (segment.to - segment.from);
        if (triangle.covers(p)) best.consider(p, p);
    }
    return best;
}

} // namespace peregrine::bench
