#include "accel/bvh/clusters.h"

#include <algorithm>
#include <bit>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kBitsPerAxis = 10;
constexpr uint32_t kDigitBits = 11;
constexpr uint32_t kLarge = 1u << 3 * kBitsPerAxis; // code of triangles that stay alone
constexpr uint32_t kDigits = 1u << kDigitBits;
constexpr uint32_t kMinChunk = 16384;
constexpr uint32_t kMaxChunks = 64;

// Of the mean area of boxes. A large triangle would spoil the box of a cluster.
constexpr double kLargeArea = 1;

// A Morton code above, the reference below.
using Key = uint64_t;

uint32_t code(Key key) {
    return uint32_t(key >> 32);
}

// Puts two zeros after each bit.
uint32_t spread(uint32_t bits) {
    bits = (bits | bits << 16) & 0x030000ffu;
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    return (bits | bits << 2) & 0x09249249u;
}

class Sorter {
public:
    Sorter(uint32_t count, base::Scheduler& scheduler, base::Memory* memory)
        : count_(count), chunk_(std::max(kMinChunk, (count + kMaxChunks - 1) / kMaxChunks)),
          chunks_((count + chunk_ - 1) / chunk_), scheduler_(scheduler), keys_(memory),
          spare_(memory), offsets_(memory) {
        keys_.allocate(count);
        spare_.allocate(count);
        offsets_.allocate(size_t(chunks_) * kDigits);
    }

    // Calls task(begin, end) for parts of the keys.
    template <class Task>
    void for_chunks(Task&& task) {
        scheduler_.for_each(chunks_, [&](uint32_t i) {
            task(i * chunk_, std::min<uint64_t>(count_, uint64_t(i + 1) * chunk_));
        });
    }

    uint32_t chunk_of(uint32_t begin) const { return begin / chunk_; }
    Key* keys() { return keys_.data(); }

    // By digits from the lowest, stable.
    void sort() {
        for (uint32_t shift = 32; shift <= 32 + 3 * kBitsPerAxis; shift += kDigitBits) pass(shift);
    }

private:
    void pass(uint32_t shift) {
        const auto digit = [shift](Key key) { return uint32_t(key >> shift) & (kDigits - 1); };
        for_chunks([&](uint32_t begin, uint64_t end) {
            uint32_t* counts = offsets_of(begin);
            std::fill_n(counts, kDigits, 0u);
            for (uint64_t i = begin; i < end; ++i) ++counts[digit(keys_[i])];
        });
        uint32_t total = 0;
        for (uint32_t d = 0; d < kDigits; ++d) {
            for (uint32_t chunk = 0; chunk < chunks_; ++chunk) {
                uint32_t& offset = offsets_[size_t(chunk) * kDigits + d];
                const uint32_t in_chunk = offset;
                offset = total;
                total += in_chunk;
            }
        }
        for_chunks([&](uint32_t begin, uint64_t end) {
            uint32_t* offsets = offsets_of(begin);
            for (uint64_t i = begin; i < end; ++i) spare_[offsets[digit(keys_[i])]++] = keys_[i];
        });
        std::swap(keys_, spare_);
    }

    uint32_t* offsets_of(uint32_t begin) {
        return offsets_.data() + size_t(begin / chunk_) * kDigits;
    }

    uint32_t count_;
    uint32_t chunk_;
    uint32_t chunks_;
    base::Scheduler& scheduler_;
    Buffer<Key> keys_;
    Buffer<Key> spare_;
    Buffer<uint32_t> offsets_;
};

// Cuts a run of keys where their highest different bit changes, until all are small.
void find_runs(const Key* keys, uint32_t begin, uint32_t end, base::Vector<Reference>& groups) {
    if (end - begin <= kMaxCluster) {
        groups.emplace_back(Reference::make(begin, Bounds(), end - begin));
        return;
    }
    uint32_t middle = begin + (end - begin) / 2;
    const uint32_t different = code(keys[begin]) ^ code(keys[end - 1]);
    if (different != 0) {
        const uint32_t bit = std::bit_floor(different);
        middle = uint32_t(std::partition_point(keys + begin, keys + end,
                                               [bit](Key key) { return (code(key) & bit) == 0; })
                          - keys);
    }
    find_runs(keys, begin, middle, groups);
    find_runs(keys, middle, end, groups);
}

// From which on a triangle is large.
template <class Area>
float mean_area(Sorter& sorter, const Reference* references, uint32_t count, const Area& area) {
    double sums[kMaxChunks] = {};
    sorter.for_chunks([&](uint32_t begin, uint64_t end) {
        double sum = 0;
        for (uint64_t i = begin; i < end; ++i) sum += double(area(references[i]));
        sums[sorter.chunk_of(begin)] = sum;
    });
    double total = 0;
    for (double sum : sums) total += sum;
    return float(kLargeArea * total / double(count));
}

} // namespace

void make_clusters(const Task& task, const Reference* references, uint32_t count,
                   const Extent& extent, base::Scheduler& scheduler, Clusters& clusters) {
    Sorter sorter(count, scheduler, task.memory);
    const float scale = scale_of(extent.bounds);
    const auto area = [scale](const Reference& reference) {
        const Bounds box = reference.bounds();
        return half_area((box.upper - box.lower) * scale);
    };
    const float large = mean_area(sorter, references, count, area);
    const BinMapping mapping(extent.centers, 1u << kBitsPerAxis);
    sorter.for_chunks([&](uint32_t begin, uint64_t end) {
        for (uint64_t i = begin; i < end; ++i) {
            const Ints cell = mapping(references[i].doubled_center());
            const uint32_t morton = spread(uint32_t(cell[0])) << 2 | spread(uint32_t(cell[1])) << 1
                                    | spread(uint32_t(cell[2]));
            const bool alone = area(references[i]) > large;
            sorter.keys()[i] = Key(alone ? kLarge : morton) << 32 | i;
        }
    });
    sorter.sort();
    const Key* const alone =
        std::lower_bound(sorter.keys(), sorter.keys() + count, Key(kLarge) << 32);
    const uint32_t sorted = uint32_t(alone - sorter.keys());
    if (sorted > 0) find_runs(sorter.keys(), 0, sorted, clusters.groups);
    for (uint32_t i = sorted; i < count; ++i)
        clusters.groups.push_back(Reference::make(i, Bounds(), 1));
    clusters.members.allocate(count);
    constexpr uint32_t kGroupsPerTask = 1024;
    const uint32_t groups = uint32_t(clusters.groups.size());
    scheduler.for_each((groups + kGroupsPerTask - 1) / kGroupsPerTask, [&](uint32_t i) {
        const uint32_t end = std::min(groups, (i + 1) * kGroupsPerTask);
        for (uint32_t g = i * kGroupsPerTask; g < end; ++g) {
            Reference& group = clusters.groups[g];
            const uint32_t first = group.triangle();
            Bounds bounds;
            for (uint32_t k = first; k < first + group.weight(); ++k) {
                const Reference& member = references[uint32_t(sorter.keys()[k])];
                clusters.members[k] = member;
                bounds.extend(member.bounds());
            }
            group = Reference::make(first, bounds, group.weight());
        }
    });
}

} // namespace peregrine::accel::bvh
