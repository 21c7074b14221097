#include "accel/bih/split.h"

#include "accel/bih/morton.h"
#include "accel/bin_mapping.h"

#include <algorithm>

namespace peregrine::accel::bih {
namespace {

constexpr uint32_t kBins = 16;
constexpr uint32_t kFewBins = 8;
constexpr uint32_t kFewReferences = 24;

uint32_t bins_for(uint32_t references) {
    return references <= kFewReferences ? kFewBins : kBins;
}

// Levels that halving needs.
uint32_t levels_for(uint32_t references) {
    return uint32_t(std::bit_width(references - 1));
}

// For each axis: where references with centres in the bin begin and end along it, and how many they
// are. The plane between two bins needs no more, since a child's cell differs from its parent's in
// one side alone.
struct Bin {
    Floats begin, end, count;
};

struct Bins {
    Bin bins[kBins];

    explicit Bins(uint32_t used) {
        const Bounds none;
        std::fill_n(bins, used, Bin{none.lower, none.upper, {}});
    }

    void add(const Reference& reference, const BinMapping& mapping) {
        const Bounds box = reference.bounds();
        const Ints place = mapping(box.lower + box.upper);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[place[axis]];
            bin.begin[axis] = std::min(bin.begin[axis], box.lower[axis]);
            bin.end[axis] = std::max(bin.end[axis], box.upper[axis]);
            ++bin.count[axis];
        }
    }
};

// The plane in front of bin `bin`. Costs are half areas, relative to the cell's, times references.
struct Plane {
    float cost = Bounds::kInfinity;
    uint32_t axis = 0;
    uint32_t bin = 0;

    bool found() const { return cost < Bounds::kInfinity; }
};

// All axes at once.
Plane sweep(const Bin* bins, uint32_t used, const Bounds& cell) {
    const float scale = scale_of(cell);
    const Floats size = (cell.upper - cell.lower) * scale;
    const Floats a = {size[1], size[2], size[0], 0}, b = {size[2], size[0], size[1], 0};
    const Floats face = a * b, girth = a + b;
    const Floats never = {Bounds::kInfinity, Bounds::kInfinity, Bounds::kInfinity, 0};
    Floats left_cost[kBins];
    Floats count = {}, end = cell.lower;
    for (uint32_t i = 0; i + 1 < used; ++i) {
        count += bins[i].count;
        end = max(end, bins[i].end);
        const Floats cost = count * (face + girth * ((end - cell.lower) * scale));
        left_cost[i] = count > 0 ? cost : never;
    }
    count = Floats{};
    Floats begin = cell.upper, best = never;
    Ints best_bin = {};
    for (uint32_t i = used - 1; i > 0; --i) {
        count += bins[i].count;
        begin = min(begin, bins[i].begin);
        const Floats cost = count * (face + girth * ((cell.upper - begin) * scale));
        const Floats both = left_cost[i - 1] + (count > 0 ? cost : never);
        best_bin = both < best ? Ints{} + int32_t(i) : best_bin;
        best = min(best, both);
    }
    const float area = accel::half_area(size);
    Plane plane;
    for (uint32_t axis = 0; axis < 3; ++axis)
        if (best[axis] < plane.cost) plane = {best[axis], axis, uint32_t(best_bin[axis])};
    if (area > 0) plane.cost /= area;
    return plane;
}

Plane find_plane(const Task& task, const Range& range) {
    const uint32_t used = bins_for(range.size());
    const BinMapping mapping(range.extent.centers, used);
    Bins bins(used);
    for (uint32_t i = range.begin; i < range.end; ++i) bins.add(task.references[i], mapping);
    return sweep(bins.bins, used, range.cell);
}

void partition(const Task& task, const Range& range, const Plane& plane, Halves& halves) {
    const BinMapping mapping(range.extent.centers, bins_for(range.size()));
    const auto is_left = [&](const Reference& reference) {
        return mapping(reference.doubled_center())[int(plane.axis)] < int(plane.bin);
    };
    Reference* left = task.references + range.begin;
    Reference* right = task.references + range.end;
    Extent left_extent, right_extent;
    while (left != right) {
        if (is_left(*left)) {
            left_extent.extend(*left++);
        } else {
            right_extent.extend(*left);
            std::swap(*left, *--right);
        }
    }
    halves.axis = plane.axis;
    halves.left.extent = left_extent;
    halves.right.extent = right_extent;
    halves.left.end = uint32_t(left - task.references);
}

// Equally many, whatever it costs: for objects that no plane separates, and for trees that have
// grown deep.
void halve(const Task& task, const Range& range, Halves& halves) {
    const Floats size = range.extent.centers.upper - range.extent.centers.lower;
    int axis = size[1] > size[0] ? 1 : 0;
    if (size[2] > size[axis]) axis = 2;
    Reference* begin = task.references + range.begin;
    const uint32_t half = range.size() / 2;
    std::nth_element(begin, begin + half, begin + range.size(),
                     [axis](const Reference& a, const Reference& b) {
                         const float at = a.lower[axis] + a.upper[axis];
                         const float bt = b.lower[axis] + b.upper[axis];
                         return at != bt ? at < bt : a.biased_triangle < b.biased_triangle;
                     });
    halves.axis = uint32_t(axis);
    halves.left.extent = extent_of({begin, half});
    halves.right.extent = extent_of({begin + half, range.size() - half});
    halves.left.end = range.begin + half;
}

} // namespace

void finish(const Range& range, Halves& halves) {
    halves.left.begin = range.begin;
    halves.right.begin = halves.left.end;
    halves.right.end = range.end;
    halves.left.depth = halves.right.depth = range.depth + 1;
    halves.left.cell = halves.right.cell = range.cell;
    const uint32_t axis = halves.axis;
    halves.left.cell.upper[axis] = halves.left.extent.bounds.upper[axis];
    halves.right.cell.lower[axis] = halves.right.extent.bounds.lower[axis];
}

bool split(const Task& task, const Range& range, Halves& halves) {
    if (task.blocks) return split_sorted(task, range, halves);
    if (range.size() == 1) return false;
    Plane plane;
    if (range.depth + levels_for(range.size()) < kMaxDepth) plane = find_plane(task, range);
    const float intersection = task.costs.intersection_cost;
    if (range.size() <= kMaxLeaf
        && !(task.costs.traversal_cost + intersection * plane.cost
             < intersection * float(range.size())))
        return false;
    if (plane.found())
        partition(task, range, plane, halves);
    else
        halve(task, range, halves);
    finish(range, halves);
    return true;
}

} // namespace peregrine::accel::bih
