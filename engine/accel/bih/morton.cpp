#include "accel/bih/morton.h"

#include "accel/bin_mapping.h"
#include "accel/buffer.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace peregrine::accel::bih {
namespace {

constexpr uint32_t kTrianglesPerTask = 16384;
static_assert(kTrianglesPerTask % kBlock == 0);
constexpr uint32_t kCells = 1u << (kMortonBits / 3); // along an axis
constexpr uint32_t kEnough = 4;                      // a leaf, whatever a split might save
constexpr uint32_t kDigitBits = 10;
constexpr uint32_t kDigits = 1u << kDigitBits;
static_assert(kMortonBits % kDigitBits == 0);

struct Key {
    uint32_t place;
    uint32_t index;
};

uint32_t spread(uint32_t x) { // of 10 bits: two zeros behind each
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

uint32_t place_of(const Ints& cell) {
    return spread(uint32_t(cell[0])) | spread(uint32_t(cell[1])) << 1
           | spread(uint32_t(cell[2])) << 2;
}

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

// By digits from the lowest one, stably.
const Key* sort(Key* keys, Key* room, size_t count) {
    for (uint32_t shift = 0; shift < kMortonBits; shift += kDigitBits) {
        uint32_t begins[kDigits] = {};
        const auto digit = [&](const Key& key) { return key.place >> shift & (kDigits - 1); };
        for (size_t i = 0; i < count; ++i) ++begins[digit(keys[i])];
        uint32_t sum = 0;
        for (uint32_t& begin : begins) sum += std::exchange(begin, sum);
        for (size_t i = 0; i < count; ++i) room[begins[digit(keys[i])]++] = keys[i];
        std::swap(keys, room);
    }
    return keys;
}

// work(begin, end) for pieces of [0, count).
template <class Work>
void for_pieces(size_t count, base::Scheduler& scheduler, Work&& work) {
    const auto tasks = uint32_t((count + kTrianglesPerTask - 1) / kTrianglesPerTask);
    scheduler.for_each(tasks, [&](uint32_t task) {
        const size_t begin = size_t(task) * kTrianglesPerTask;
        work(begin, std::min(count, begin + kTrianglesPerTask));
    });
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
    const size_t count = triangles.size();
    Buffer<Reference> unsorted(memory);
    Buffer<Key> keys(memory), room(memory);
    unsorted.allocate(count);
    keys.allocate(count);
    room.allocate(count);
    const Extent extent = make_references(triangles, scheduler, memory, unsorted.data());
    const float scale = float(kCells) * scale_of(extent.centers);
    const Floats last = {kCells - 1, kCells - 1, kCells - 1, 0};
    for_pieces(count, scheduler, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Floats at = (unsorted[i].doubled_center() - extent.centers.lower) * scale;
            keys[i] = {place_of(__builtin_convertvector(min(at, last), Ints)), uint32_t(i)};
        }
    });
    const Key* const sorted = sort(keys.data(), room.data(), count);
    for_pieces(count, scheduler, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Bounds bounds = unsorted[sorted[i].index].bounds();
            references[i] = Reference::make(sorted[i].index, bounds, sorted[i].place);
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
