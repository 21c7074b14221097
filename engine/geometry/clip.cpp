#include "geometry/clip.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace peregrine::geometry {
namespace {

// Why no point p of triangle and cell is lost. A cut interpolates a + t (b - a) between |a|, |b| <=
// M, the triangle's largest coordinate. With e = 2^-53, t is off by 3 e, b - a and the product by
// e each, of at most 2 M; the sum by e M: together 11 e M, or, in the six cuts of a box and as a
// Euclidean length, sqrt(3) 66 e M < 2^-46 M. Every plane is pushed outward by twice as much. Now
// see the polygon's outline as a closed curve: an exact cut replaces what lies beyond the plane by
// a segment in it, which stays away from p, so the curve winds round p as often as before. Only a
// rounding error can carry it over p, but then it passes within 2^-46 M of p, so far inside all
// planes that no later cut removes that spot. In either case p lies in the box round the final
// outline widened by the margin.
constexpr double kMargin = 0x1p-45;

// GCC's and Clang's vectors.
using Doubles [[gnu::vector_size(16)]] = double;
using Longs [[gnu::vector_size(16)]] = int64_t;

struct Point {
    double at[4]; // the last is 0

    Doubles load(uint32_t first) const {
        Doubles pair;
        std::memcpy(&pair, at + first, sizeof pair);
        return pair;
    }
    void store(uint32_t first, const Doubles& pair) { std::memcpy(at + first, &pair, sizeof pair); }
};

// An outline that almost lies in a plane may be bent by rounding and cross it more than twice, at
// most at every edge: a cut makes 1.5 n of n vertices, and six cuts 4, 6, 9, 13, 19, 28 of 3.
struct Polygon {
    Point vertices[28];
    uint32_t count = 0;
};

struct Cell {
    float lower[3];
    float upper[3];

    explicit Cell(const Box& box)
        : lower{box.lower.x, box.lower.y, box.lower.z},
          upper{box.upper.x, box.upper.y, box.upper.z} {}
};

struct Bounds {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Doubles lower[2] = {{kInfinity, kInfinity}, {kInfinity, kInfinity}};
    Doubles upper[2] = {{-kInfinity, -kInfinity}, {-kInfinity, -kInfinity}};

    void extend(const Point& point) {
        for (uint32_t i = 0; i < 2; ++i) {
            const Doubles pair = point.load(2 * i);
            lower[i] = pair < lower[i] ? pair : lower[i];
            upper[i] = pair > upper[i] ? pair : upper[i];
        }
    }
};

constexpr Longs kIsAxis[3][2] = {{{-1, 0}, {0, 0}}, {{0, -1}, {0, 0}}, {{0, 0}, {-1, 0}}};

Point cut(const Point& a, const Point& b, uint32_t axis, double plane) {
    const double t = (plane - a.at[axis]) / (b.at[axis] - a.at[axis]);
    Point point;
    for (uint32_t i = 0; i < 2; ++i) {
        const Doubles from = a.load(2 * i);
        point.store(2 * i,
                    kIsAxis[axis][i] ? Doubles{plane, plane} : from + t * (b.load(2 * i) - from));
    }
    return point;
}

template <bool kBelow>
bool is_inside(const Point& point, uint32_t axis, double plane) {
    return kBelow ? point.at[axis] <= plane : point.at[axis] >= plane;
}

// Sutherland and Hodgman 1974: hands the outline on one side of a plane to `emit`.
template <bool kBelow, class Emit>
void cut_polygon(const Polygon& polygon, uint32_t axis, double plane, Emit&& emit) {
    if (polygon.count == 0) return;
    const Point* a = &polygon.vertices[polygon.count - 1];
    bool a_inside = is_inside<kBelow>(*a, axis, plane);
    for (uint32_t i = 0; i < polygon.count; ++i) {
        const Point* b = &polygon.vertices[i];
        const bool b_inside = is_inside<kBelow>(*b, axis, plane);
        if (a_inside != b_inside) emit(cut(*a, *b, axis, plane));
        if (b_inside) emit(*b);
        a = b;
        a_inside = b_inside;
    }
}

// The outline of a triangle within a cell, and the margin that belongs to it.
class Outline {
public:
    Outline(const Triangle& triangle, const Cell& cell) {
        const math::Vec3* vertices[3] = {&triangle.v0, &triangle.v1, &triangle.v2};
        double largest = 0;
        Bounds corners;
        for (const math::Vec3* vertex : vertices) {
            const Point point{{double(vertex->x), double(vertex->y), double(vertex->z), 0}};
            for (double coordinate : point.at) largest = std::max(largest, std::abs(coordinate));
            polygon_->vertices[polygon_->count++] = point;
            corners.extend(point);
        }
        margin_ = kMargin * largest;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            if (corners.lower[axis / 2][axis % 2] < double(cell.lower[axis]))
                keep<false>(axis, double(cell.lower[axis]) - margin_);
            if (corners.upper[axis / 2][axis % 2] > double(cell.upper[axis]))
                keep<true>(axis, double(cell.upper[axis]) + margin_);
        }
    }

    Bounds bounds() const {
        Bounds bounds;
        for (uint32_t i = 0; i < polygon_->count; ++i) bounds.extend(polygon_->vertices[i]);
        return bounds;
    }

    template <bool kBelow>
    Bounds bounds_of_side(uint32_t axis, double plane) const {
        Bounds bounds;
        cut_polygon<kBelow>(*polygon_, axis, kBelow ? plane + margin_ : plane - margin_,
                            [&](const Point& point) { bounds.extend(point); });
        return bounds;
    }

    double margin() const { return margin_; }

private:
    template <bool kBelow>
    void keep(uint32_t axis, double plane) {
        uint32_t inside = 0;
        for (uint32_t i = 0; i < polygon_->count; ++i)
            inside += is_inside<kBelow>(polygon_->vertices[i], axis, plane);
        if (inside == polygon_->count) return;
        spare_->count = 0;
        cut_polygon<kBelow>(*polygon_, axis, plane,
                            [&](const Point& point) { spare_->vertices[spare_->count++] = point; });
        std::swap(polygon_, spare_);
    }

    Polygon polygons_[2];
    Polygon* polygon_ = &polygons_[0];
    Polygon* spare_ = &polygons_[1];
    double margin_;
};

float round_down(double value) {
    const float nearest = float(value);
    if (double(nearest) <= value) return nearest;
    if (nearest == 0) return -std::numeric_limits<float>::denorm_min();
    const int32_t bits = std::bit_cast<int32_t>(nearest);
    return std::bit_cast<float>(bits + (bits < 0 ? 1 : -1)); // the next one towards -infinity
}

float round_up(double value) {
    return -round_down(-value);
}

Box widen(const Bounds& bounds, double margin) {
    const Doubles* lower = bounds.lower;
    const Doubles* upper = bounds.upper;
    if (lower[0][0] > upper[0][0]) return {};
    return {{round_down(lower[0][0] - margin), round_down(lower[0][1] - margin),
             round_down(lower[1][0] - margin)},
            {round_up(upper[0][0] + margin), round_up(upper[0][1] + margin),
             round_up(upper[1][0] + margin)}};
}

} // namespace

Box clip(const Triangle& triangle, const Box& cell) {
    const Outline outline(triangle, Cell(cell));
    return math::intersection(widen(outline.bounds(), outline.margin()),
                              math::intersection(cell, bounds(triangle)));
}

ClippedHalves clip_to_halves(const Triangle& triangle, const Box& cell, uint32_t axis,
                             float position, const Box& known) {
    const Outline outline(triangle, Cell(cell));
    const Bounds below = outline.bounds_of_side<true>(axis, double(position));
    const Bounds above = outline.bounds_of_side<false>(axis, double(position));
    Box left = math::intersection(known, cell);
    Box right = left;
    left.upper[int(axis)] = std::min(left.upper[int(axis)], position);
    right.lower[int(axis)] = std::max(right.lower[int(axis)], position);
    return {math::intersection(widen(below, outline.margin()), left),
            math::intersection(widen(above, outline.margin()), right)};
}

} // namespace peregrine::geometry
