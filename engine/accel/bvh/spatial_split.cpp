#include "accel/bvh/spatial_split.h"

#include "accel/bvh/object_split.h"

#include <algorithm>

namespace peregrine::accel::bvh {
namespace {

// Bins of equal width between the planes of one axis.
struct Planes {
    float origin;
    float width;
    float scale;
    int bins;

    Planes(const Bounds& bounds, int axis, uint32_t count)
        : origin(bounds.lower[axis]), width((bounds.upper[axis] - origin) / float(count)),
          scale(width > 0 ? std::min(1 / width, std::numeric_limits<float>::max()) : 0),
          bins(int(count)) {}

    int bin(float coordinate) const {
        return int(std::min(std::max((coordinate - origin) * scale, 0.0f), float(bins - 1)));
    }
    float position(int plane) const { return origin + width * float(plane); }
};

struct SpatialBins {
    Bounds bounds[kMaxSpatialBins];
    Bounds parts[kMaxSpatialBins]; // of one triangle
    uint32_t entries[kMaxSpatialBins];
    uint32_t exits[kMaxSpatialBins];
};

// Where a triangle lies in bins first to last. Not conservative: it only guides the choice.
void chop(const geometry::Triangle& triangle, int axis, const Planes& planes, int first, int last,
          Bounds* parts) {
    const Floats vertices[3] = {load(triangle.v0), load(triangle.v1), load(triangle.v2)};
    int bins[3];
    for (int i = 0; i < 3; ++i) {
        bins[i] = planes.bin(vertices[i][axis]);
        if (bins[i] >= first && bins[i] <= last) parts[bins[i]].extend(vertices[i]);
    }
    for (int i = 0; i < 3; ++i) {
        int a = i;
        int b = i == 2 ? 0 : i + 1;
        if (bins[a] > bins[b]) std::swap(a, b);
        const int begin = std::max(bins[a] + 1, first);
        const int end = std::min(bins[b], last + 1);
        if (begin > end) continue;
        const Floats edge = vertices[b] - vertices[a];
        const float inverse = 1 / edge[axis];
        for (int plane = begin; plane <= end; ++plane) {
            const float t = (planes.position(plane) - vertices[a][axis]) * inverse;
            const Floats point = vertices[a] + edge * t;
            if (plane > first) parts[plane - 1].extend(point);
            if (plane <= last) parts[plane].extend(point);
        }
    }
}

void fill(const geometry::Triangle* triangles, std::span<const Reference> references, int axis,
          const Planes& planes, SpatialBins& bins) {
    Bounds* const parts = bins.parts;
    for (int i = 0; i < planes.bins; ++i) bins.bounds[i] = {}, bins.entries[i] = bins.exits[i] = 0;
    for (const Reference& reference : references) {
        const int first = planes.bin(reference.lower[axis]);
        const int last = planes.bin(reference.upper[axis]);
        ++bins.entries[first];
        ++bins.exits[last];
        const Bounds whole = reference.bounds();
        if (first == last) {
            bins.bounds[first].extend(whole);
            continue;
        }
        std::fill(parts + first, parts + last + 1, Bounds());
        chop(triangles[reference.triangle()], axis, planes, first, last, parts);
        for (int i = first; i <= last; ++i) {
            bins.bounds[i].lower = min(bins.bounds[i].lower, max(parts[i].lower, whole.lower));
            bins.bounds[i].upper = max(bins.bounds[i].upper, min(parts[i].upper, whole.upper));
        }
    }
}

void sweep(const SpatialBins& bins, const Planes& planes, uint32_t axis, float scale,
           uint32_t most_references, SpatialSplit& best) {
    float left_cost[kMaxSpatialBins];
    uint32_t left_count[kMaxSpatialBins];
    Bounds box;
    uint32_t count = 0;
    for (int i = 0; i + 1 < planes.bins; ++i) {
        box.extend(bins.bounds[i]);
        count += bins.entries[i];
        left_count[i] = count;
        left_cost[i] = half_area((box.upper - box.lower) * scale) * blocks_of(count);
    }
    box = {};
    count = 0;
    for (int i = planes.bins - 1; i > 0; --i) {
        box.extend(bins.bounds[i]);
        count += bins.exits[i];
        const uint32_t left = left_count[i - 1];
        if (count == 0 || left == 0 || left + count > most_references) continue;
        const float cost =
            left_cost[i - 1] + half_area((box.upper - box.lower) * scale) * blocks_of(count);
        if (cost < best.cost) best = {cost, axis, planes.position(i), left, count};
    }
}

} // namespace

SpatialSplit find_spatial_split(const geometry::Triangle* triangles,
                                std::span<const Reference> references, const Bounds& bounds,
                                uint32_t bins, uint32_t most_duplicates) {
    SpatialSplit best;
    const float scale = scale_of(bounds);
    SpatialBins content;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const Planes planes(bounds, int(axis), bins);
        if (planes.scale == 0) continue;
        fill(triangles, references, int(axis), planes, content);
        sweep(content, planes, axis, scale, uint32_t(references.size()) + most_duplicates, best);
    }
    const float area = half_area((bounds.upper - bounds.lower) * scale);
    if (area > 0) best.cost /= area;
    return best;
}

} // namespace peregrine::accel::bvh
