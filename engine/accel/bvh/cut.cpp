#include "accel/bvh/cut.h"

#include <algorithm>
#include <cmath>

namespace peregrine::accel::bvh {
namespace {

// The part below a plane is the convex hull of the vertices below and of the points where edges
// cross the plane. In double these are off by less than 2^-46 of the largest coordinate (see
// geometry/clip.cpp), so that points this far around them hold the exact ones.
constexpr double kMargin = 0x1p-45;

// One or two floats further, denormal ones included.
float round_down(double value) {
    const float nearest = float(value);
    return nearest - (std::fabs(nearest) * 0x1p-23f + std::numeric_limits<float>::denorm_min());
}
float round_up(double value) {
    return -round_down(-value);
}

void intersect(Bounds& bounds, const Bounds& other) {
    bounds.lower = max(bounds.lower, other.lower);
    bounds.upper = min(bounds.upper, other.upper);
}

} // namespace

Halves cut(const geometry::Triangle& triangle, const Reference& reference, uint32_t axis,
           float position) {
    const math::Vec3* vertices[3] = {&triangle.v0, &triangle.v1, &triangle.v2};
    const int k = int(axis);
    Halves halves;
    float largest = 0;
    for (const math::Vec3* vertex : vertices) {
        const float coordinate = (*vertex)[k];
        if (coordinate <= position) halves.below.extend(load(*vertex));
        if (coordinate >= position) halves.above.extend(load(*vertex));
        for (int i = 0; i < 3; ++i) largest = std::max(largest, std::fabs((*vertex)[i]));
    }
    const double margin = kMargin * double(largest);
    const math::Vec3* a = vertices[2];
    for (const math::Vec3* b : vertices) {
        const float from = (*a)[k];
        const float to = (*b)[k];
        if ((from < position && to > position) || (from > position && to < position)) {
            const double t = (double(position) - double(from)) / (double(to) - double(from));
            Bounds point;
            for (int i = 0; i < 3; ++i) {
                const double start = double((*a)[i]);
                const double at = start + t * (double((*b)[i]) - start);
                point.lower[i] = round_down(at - margin);
                point.upper[i] = round_up(at + margin);
            }
            halves.below.extend(point);
            halves.above.extend(point);
        }
        a = b;
    }
    const Bounds whole = reference.bounds();
    intersect(halves.below, whole);
    intersect(halves.above, whole);
    halves.below.upper[k] = std::min(halves.below.upper[k], position);
    halves.above.lower[k] = std::max(halves.above.lower[k], position);
    return halves;
}

} // namespace peregrine::accel::bvh
