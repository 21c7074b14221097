#include "accel/bih/split.h"

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

// What a child's planes need to know: where references with centres in the bin begin and end, along
// the axis alone.
struct Bin {
    float begin = Bounds::kInfinity;
    float end = -Bounds::kInfinity;
    uint32_t count = 0;
};

struct Bins {
    Bin axes[3][kBins];

    void add(const Reference& reference, const bvh::BinMapping& mapping) {
        const bvh::Ints place = mapping(reference.doubled_center());
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = axes[axis][place[axis]];
            bin.begin = std::min(bin.begin, reference.lower[axis]);
            bin.end = std::max(bin.end, reference.upper[axis]);
            ++bin.count;
        }
    }
};

// The plane in front of bin `bin`. Costs are half areas times references.
struct Plane {
    double cost = std::numeric_limits<double>::infinity();
    uint32_t axis = 0;
    uint32_t bin = 0;

    bool found() const { return cost < std::numeric_limits<double>::infinity(); }
};

// A child's cell differs from its parent's in one side alone, so its area is linear in its length.
void sweep(const Bin* bins, uint32_t used, uint32_t axis, const Bounds& cell, Plane& best) {
    const uint32_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double size_a = double(cell.upper[a]) - double(cell.lower[a]);
    const double size_b = double(cell.upper[b]) - double(cell.lower[b]);
    const double face = size_a * size_b;
    const double girth = size_a + size_b;
    double left_cost[kBins];
    uint32_t count = 0;
    float end = cell.lower[axis];
    for (uint32_t i = 0; i + 1 < used; ++i) {
        count += bins[i].count;
        end = std::max(end, bins[i].end);
        const double length = double(end) - double(cell.lower[axis]);
        left_cost[i] =
            count > 0 ? count * (face + girth * length) : std::numeric_limits<double>::infinity();
    }
    count = 0;
    float begin = cell.upper[axis];
    for (uint32_t i = used - 1; i > 0; --i) {
        count += bins[i].count;
        begin = std::min(begin, bins[i].begin);
        if (count == 0) continue;
        const double length = double(cell.upper[axis]) - double(begin);
        const double cost = left_cost[i - 1] + count * (face + girth * length);
        if (cost < best.cost) best = {cost, axis, i};
    }
}

Plane find_plane(const Task& task, const Range& range) {
    const uint32_t used = bins_for(range.size());
    const bvh::BinMapping mapping(range.extent.centers, used);
    Bins bins;
    for (uint32_t i = range.begin; i < range.end; ++i) bins.add(task.references[i], mapping);
    Plane best;
    for (uint32_t axis = 0; axis < 3; ++axis) sweep(bins.axes[axis], used, axis, range.cell, best);
    return best;
}

void partition(const Task& task, const Range& range, const Plane& plane, Halves& halves) {
    const bvh::BinMapping mapping(range.extent.centers, bins_for(range.size()));
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
    const bvh::Floats size = range.extent.centers.upper - range.extent.centers.lower;
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
    halves.left.extent = bvh::extent_of({begin, half});
    halves.right.extent = bvh::extent_of({begin + half, range.size() - half});
    halves.left.end = range.begin + half;
}

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

} // namespace

bool split(const Task& task, const Range& range, Halves& halves) {
    if (range.size() == 1) return false;
    Plane plane;
    if (range.depth + levels_for(range.size()) < kMaxDepth) plane = find_plane(task, range);
    const double traversal = double(task.costs.traversal_cost);
    const double intersection = double(task.costs.intersection_cost);
    const double area = half_area(range.cell);
    if (range.size() <= kMaxLeaf
        && !(traversal * area + intersection * plane.cost < intersection * range.size() * area))
        return false;
    if (plane.found())
        partition(task, range, plane, halves);
    else
        halve(task, range, halves);
    finish(range, halves);
    return true;
}

} // namespace peregrine::accel::bih
