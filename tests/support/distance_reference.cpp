#include "support/distance_reference.h"

#include <algorithm>
#include <cmath>

namespace peregrine::test {
namespace {

Real length(const Point3& v) {
    return std::sqrt(glm::dot(v, v));
}

Real to_segment(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 ab = b - a;
    const Real square = glm::dot(ab, ab);
    const Real s = square > 0 ? std::clamp(glm::dot(p - a, ab) / square, Real(0), Real(1)) : 0;
    return length(p - (a + s * ab));
}

} // namespace

Real distance(const Point3& p, const ReferenceTriangle& t) {
    const Point3 ab = t.b - t.a, ac = t.c - t.a;
    const Point3 ap = p - t.a, bp = p - t.b, cp = p - t.c;
    const Real d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    const Real d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    const Real d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    const Real va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    const Real edges =
        std::min({to_segment(p, t.a, t.b), to_segment(p, t.b, t.c), to_segment(p, t.c, t.a)});
    if (!(va > 0 && vb > 0 && vc > 0)) return edges;
    const Real sum = va + vb + vc;
    return std::min(edges, length(p - (t.a + ab * (vb / sum) + ac * (vc / sum))));
}

Real distance(const Point3& center, const Point3& axis, const ReferenceTriangle& triangle) {
    if (axis == Point3(0)) return distance(center, triangle);
    return find_minimum(-1, 1, [&](Real s) { return distance(center + s * axis, triangle); }).value;
}

Minimum find_minimum(Real begin, Real end, const std::function<Real(Real)>& f) {
    // Golden sections.
    const Real ratio = (std::sqrt(Real(5)) - 1) / 2;
    Real x0 = end - ratio * (end - begin), x1 = begin + ratio * (end - begin);
    Real f0 = f(x0), f1 = f(x1);
    Minimum best = {begin, f(begin)};
    const auto offer = [&](Real x, Real value) {
        if (value < best.value) best = {x, value};
    };
    offer(end, f(end));
    for (int i = 0; i < 90; ++i) {
        offer(x0, f0);
        offer(x1, f1);
        if (f0 <= f1) {
            end = x1;
            x1 = x0;
            f1 = f0;
            x0 = end - ratio * (end - begin);
            f0 = f(x0);
        } else {
            begin = x0;
            x0 = x1;
            f0 = f1;
            x1 = begin + ratio * (end - begin);
            f1 = f(x1);
        }
    }
    return best;
}

Real find_first(Real begin, Real end, Real level, const std::function<Real(Real)>& f) {
    for (int i = 0; i < 100; ++i) {
        const Real middle = (begin + end) / 2;
        (f(middle) > level ? begin : end) = middle;
    }
    return end;
}

} // namespace peregrine::test
