#include "accel/bih/morton.h"

#include "accel/bin_mapping.h"
#include "accel/morton_order.h"

#include <algorithm>
#include <bit>

namespace peregrine::accel::bih {
namespace {

constexpr uint32_t kTrianglesPerTask = 16384;
static_assert(kTrianglesPerTask % kBlock == 0);
constexpr uint32_t kEnough = 4; // a leaf, whatever a split might save

void extend(Bounds& bounds, const Task& task, uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; ++i) bounds.extend(task.references[i].bounds());
}

// Of references [begin, end), by whole blocks where there are any.
Bounds bounds_of(const Task& task, uint32_t begin, uint32_t end) {
    const uint32_t first = (begin + kBlock - 1) / kBlock, last = end / kBlock;
    Bounds bounds;
    if (first >= last) {
        extend(bounds, task, begin, end);
        return bounds;
    }
    extend(bounds, task, begin, first * kBlock);
    for (uint32_t block = first; block < last; ++block) bounds.extend(task.blocks[block]);
    extend(bounds, task, last * kBlock, end);
    return bounds;
}

float cost_of(const Range& range, const Halves& halves) {
    const float scale = scale_of(range.cell);
    const float area = accel::half_area((range.cell.upper - range.cell.lower) * scale);
    if (!(area > 0)) return float(range.size());
    const auto part = [&](const Range& half) {
        return float(half.size()) * accel::half_area((half.cell.upper - half.cell.lower) * scale);
    };
    return (part(halves.left) + part(halves.right)) / area;
}

} // namespace

Bounds make_sorted_references(std::span<const geometry::Triangle> triangles,
                              base::Scheduler& scheduler, base::Memory* memory,
                              Reference* references, Bounds* blocks) {
    const Extent extent = extent_of(triangles, scheduler, memory);
    const Buffer<MortonKey> keys =
        sort_along_morton_curve(triangles, extent.centers, kMaxMortonBits, scheduler, memory);
    const size_t count = triangles.size();
    const auto tasks = uint32_t((count + kTrianglesPerTask - 1) / kTrianglesPerTask);
    scheduler.for_each(tasks, [&](uint32_t task) {
        const size_t begin = size_t(task) * kTrianglesPerTask;
        for (size_t i = begin; i < std::min(count, begin + kTrianglesPerTask); ++i) {
            const Bounds bounds = accel::bounds_of(triangles[keys[i].item]);
            references[i] = Reference::make(keys[i].item, bounds, keys[i].place);
            if (i % kBlock == 0) blocks[i / kBlock] = Bounds{};
            blocks[i / kBlock].extend(bounds);
        }
    });
    return extent.bounds;
}

bool split_sorted(const Task& task, const Range& range, Halves& halves) {
    if (range.size() <= kEnough) return false;
    const Reference* const references = task.references;
    const uint32_t first = references[range.begin].weight();
    const uint32_t differing = first ^ references[range.end - 1].weight();
    uint32_t middle = range.begin + range.size() / 2; // of what lies at one place
    halves.axis = 0;
    if (differing != 0) {
        const auto bit = uint32_t(std::bit_width(differing)) - 1;
        const uint32_t behind = ((first >> bit) + 1) << bit; // the first place there
        middle = uint32_t(std::partition_point(references + range.begin, references + range.end,
                                               [&](const Reference& reference) {
                                                   return reference.weight() < behind;
                                               })
                          - references);
        halves.axis = bit % 3;
    }
    halves.left.end = middle;
    halves.left.extent.bounds = bounds_of(task, range.begin, middle);
    halves.right.extent.bounds = bounds_of(task, middle, range.end);
    finish(range, halves);
    return range.size() > kMaxLeaf
           || task.costs.traversal_cost + task.costs.intersection_cost * cost_of(range, halves)
                  < task.costs.intersection_cost * float(range.size());
}

} // namespace peregrine::accel::bih
