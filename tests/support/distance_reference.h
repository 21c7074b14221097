#pragma once

#include "math/vec.h"

#include <functional>

// Distances of shapes from triangles by search, in long double: slow, and made of nothing that the
// engine's tests are made of.
namespace peregrine::test {

using Real = long double;
using Point3 = glm::vec<3, Real>;

struct ReferenceTriangle {
    Point3 a, b, c;
};

// By the Voronoi region that the point lies in (Ericson, Real-Time Collision Detection, 5.1.5).
Real distance(const Point3& point, const ReferenceTriangle& triangle);

// Of the segment center - axis to center + axis. The distance is convex along it.
Real distance(const Point3& center, const Point3& axis, const ReferenceTriangle& triangle);

struct Minimum {
    Real at, value;
};
// Of a convex function.
Minimum find_minimum(Real begin, Real end, const std::function<Real(Real)>& f);

// Where a convex function first falls to `level`; value(begin) is above it, value(end) not.
Real find_first(Real begin, Real end, Real level, const std::function<Real(Real)>& f);

} // namespace peregrine::test
