#include "accel/bvh/object_split.h"

#include <algorithm>

namespace peregrine::accel::bvh {
namespace {

struct Bins {
    Bounds bounds[kMaxBins][3];
    uint32_t counts[kMaxBins][4];

    explicit Bins(uint32_t used) {
        for (uint32_t i = 0; i < used; ++i)
            for (uint32_t axis = 0; axis < 3; ++axis) bounds[i][axis] = {}, counts[i][axis] = 0;
    }

    void add(const Reference& reference, const BinMapping& mapping) {
        const Bounds box = reference.bounds();
        const Ints bin = mapping(box.lower + box.upper);
        const uint32_t weight = reference.weight();
        for (int axis = 0; axis < 3; ++axis) {
            bounds[bin[axis]][axis].extend(box);
            counts[bin[axis]][axis] += weight;
        }
    }
};

void sweep(const Bins& bins, uint32_t used, uint32_t axis, float scale, Split& best) {
    float left_cost[kMaxBins];
    Bounds box;
    uint32_t count = 0;
    for (uint32_t i = 0; i + 1 < used; ++i) {
        box.extend(bins.bounds[i][axis]);
        count += bins.counts[i][axis];
        left_cost[i] = count > 0 ? half_area((box.upper - box.lower) * scale) * blocks_of(count)
                                 : std::numeric_limits<float>::infinity();
    }
    box = {};
    count = 0;
    for (uint32_t i = used - 1; i > 0; --i) {
        box.extend(bins.bounds[i][axis]);
        count += bins.counts[i][axis];
        if (count == 0) continue;
        const float cost =
            left_cost[i - 1] + half_area((box.upper - box.lower) * scale) * blocks_of(count);
        if (cost < best.cost) {
            best.cost = cost;
            best.axis = axis;
            best.bin = i;
        }
    }
}

} // namespace

Split find_split(std::span<const Reference> references, const Extent& extent, uint32_t bins) {
    const BinMapping mapping(extent.centers, bins);
    Bins content(bins);
    for (const Reference& reference : references) content.add(reference, mapping);
    Split best;
    const float scale = scale_of(extent.bounds);
    for (uint32_t axis = 0; axis < 3; ++axis) sweep(content, bins, axis, scale, best);
    const float area = half_area((extent.bounds.upper - extent.bounds.lower) * scale);
    if (area > 0) best.cost /= area;
    if (!best.found()) return best;
    Bounds left, right;
    for (uint32_t i = 0; i < best.bin; ++i) left.extend(content.bounds[i][best.axis]);
    for (uint32_t i = best.bin; i < bins; ++i) right.extend(content.bounds[i][best.axis]);
    best.common =
        max(min(left.upper, right.upper) - max(left.lower, right.lower), Floats{0, 0, 0, 0});
    return best;
}

} // namespace peregrine::accel::bvh
