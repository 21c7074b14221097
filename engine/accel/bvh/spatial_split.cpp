#include "accel/bvh/spatial_split.h"

#include "accel/bvh/object_split.h"

#include <algorithm>

namespace peregrine::accel::bvh {
namespace {

// Bins of equal width, on each axis.
class Planes {
public:
    Planes(const Bounds& bounds, uint32_t bins)
        : origin_(bounds.lower), width_((bounds.upper - bounds.lower) / float(bins)) {
        for (int axis = 0; axis < 3; ++axis) {
            scale_[axis] = width_[axis] > 0
                               ? std::min(1 / width_[axis], std::numeric_limits<float>::max())
                               : 0;
            last_[axis] = float(bins - 1);
        }
    }

    bool has(int axis) const { return scale_[axis] > 0; }
    Ints bins_of(const Floats& point) const {
        const Floats bin = min(max((point - origin_) * scale_, Floats{0, 0, 0, 0}), last_);
        return __builtin_convertvector(bin, Ints);
    }
    float position(int axis, int plane) const {
        return origin_[axis] + width_[axis] * float(plane);
    }

private:
    Floats origin_;
    Floats width_;
    Floats scale_ = {};
    Floats last_ = {};
};

struct SpatialBins {
    Bounds bounds[3][kMaxSpatialBins];
    uint32_t entries[3][kMaxSpatialBins];
    uint32_t exits[3][kMaxSpatialBins];

    explicit SpatialBins(uint32_t used) {
        for (uint32_t axis = 0; axis < 3; ++axis)
            for (uint32_t i = 0; i < used; ++i)
                bounds[axis][i] = {}, entries[axis][i] = exits[axis][i] = 0;
    }
};

// Where planes perpendicular to one axis meet the line through two points.
struct Line {
    Line(const Floats& a, const Floats& b, int axis) : from(a), start(a[axis]) {
        const float length = b[axis] - start;
        step = (b - a) * (length > 0 ? 1 / length : 0);
    }
    Floats at(float position) const { return from + step * (position - start); }

    Floats from;
    Floats step;
    float start;
};

// Adds what the bins from first to last cut from a triangle within a box. Not conservative: it only
// guides the choice. Each plane meets the longest edge and one of the others.
void chop(const Floats* vertices, const Bounds& whole, int axis, const Planes& planes, int first,
          int last, Bounds* bins) {
    const Floats* a = &vertices[0];
    const Floats* b = &vertices[1];
    const Floats* c = &vertices[2];
    if ((*a)[axis] > (*b)[axis]) std::swap(a, b);
    if ((*b)[axis] > (*c)[axis]) std::swap(b, c);
    if ((*a)[axis] > (*b)[axis]) std::swap(a, b);
    const float middle = (*b)[axis];
    const Line longest(*a, *c, axis);
    const Line lower(*a, *b, axis);
    const Line upper(*b, *c, axis);
    const auto cut_at = [&](float position) {
        Bounds cut;
        const Floats one = longest.at(position);
        const Floats other = position < middle ? lower.at(position) : upper.at(position);
        cut.lower = min(one, other);
        cut.upper = max(one, other);
        return cut;
    };

    float position = std::max(planes.position(axis, first), (*a)[axis]);
    Bounds below = cut_at(position);
    for (int i = first; i <= last; ++i) {
        const float next = std::min(planes.position(axis, i + 1), (*c)[axis]);
        const Bounds above = cut_at(next);
        Bounds part = below;
        part.extend(above);
        if (position <= middle && middle <= next) part.extend(*b);
        bins[i].lower = min(bins[i].lower, max(part.lower, whole.lower));
        bins[i].upper = max(bins[i].upper, min(part.upper, whole.upper));
        below = above;
        position = next;
    }
}

void fill(const geometry::Triangle* triangles, std::span<const Reference> references,
          const Planes& planes, SpatialBins& bins) {
    for (const Reference& reference : references) {
        const Bounds whole = reference.bounds();
        const Ints first = planes.bins_of(whole.lower);
        const Ints last = planes.bins_of(whole.upper);
        const geometry::Triangle& triangle = triangles[reference.triangle()];
        const Floats vertices[3] = {load(triangle.v0), load(triangle.v1), load(triangle.v2)};
        for (int axis = 0; axis < 3; ++axis) {
            ++bins.entries[axis][first[axis]];
            ++bins.exits[axis][last[axis]];
            if (first[axis] == last[axis])
                bins.bounds[axis][first[axis]].extend(whole);
            else
                chop(vertices, whole, axis, planes, first[axis], last[axis], bins.bounds[axis]);
        }
    }
}

void sweep(const SpatialBins& bins, uint32_t used, uint32_t axis, const Planes& planes, float scale,
           uint32_t most_references, SpatialSplit& best) {
    float left_cost[kMaxSpatialBins];
    uint32_t left_count[kMaxSpatialBins];
    Bounds box;
    uint32_t count = 0;
    for (uint32_t i = 0; i + 1 < used; ++i) {
        box.extend(bins.bounds[axis][i]);
        count += bins.entries[axis][i];
        left_count[i] = count;
        left_cost[i] = half_area((box.upper - box.lower) * scale) * blocks_of(count);
    }
    box = {};
    count = 0;
    for (uint32_t i = used - 1; i > 0; --i) {
        box.extend(bins.bounds[axis][i]);
        count += bins.exits[axis][i];
        const uint32_t left = left_count[i - 1];
        if (count == 0 || left == 0 || left + count > most_references) continue;
        const float cost =
            left_cost[i - 1] + half_area((box.upper - box.lower) * scale) * blocks_of(count);
        if (cost < best.cost) best = {cost, axis, planes.position(int(axis), int(i)), left, count};
    }
}

} // namespace

SpatialSplit find_spatial_split(const geometry::Triangle* triangles,
                                std::span<const Reference> references, const Bounds& bounds,
                                uint32_t bins, uint32_t most_duplicates) {
    SpatialSplit best;
    const float scale = scale_of(bounds);
    const Planes planes(bounds, bins);
    SpatialBins content(bins);
    fill(triangles, references, planes, content);
    for (uint32_t axis = 0; axis < 3; ++axis)
        if (planes.has(int(axis)))
            sweep(content, bins, axis, planes, scale, uint32_t(references.size()) + most_duplicates,
                  best);
    const float area = half_area((bounds.upper - bounds.lower) * scale);
    if (area > 0) best.cost /= area;
    return best;
}

} // namespace peregrine::accel::bvh
