#include "accel/bvh/agglomeration.h"

#include "accel/bin_mapping.h"
#include "accel/bvh/tree.h"

#include <algorithm>
#include <bit>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kChunk = 2048;
constexpr uint32_t kChunksPerTask = 8;
constexpr uint32_t kEnough = 64;   // triangles of a cluster, on average
constexpr float kLargest = 128;    // a cluster's area: the root's by the number of triangles
constexpr uint32_t kFewPairs = 32; // one in as many items: not worth another round
constexpr uint32_t kAhead = 16;    // triangles that are fetched
constexpr uint32_t kLanes = 4;

constexpr float kMost = std::numeric_limits<float>::max();
constexpr Floats kNone = Floats{} + Bounds::kInfinity;

// Items are subtrees yet to be joined, in the curve's order; their numbers are those of triangles
// in the chunk or, kChunk further, of nodes.
struct Scratch {
    Reference items[kChunk + kLanes + 1];
    int32_t keys[kChunk + kLanes];
    uint32_t firsts[kChunk]; // of pairs to be joined
    uint32_t kept[kChunk];
    BinaryNode nodes[kChunk];
    uint32_t weights[kChunk]; // of nodes
};

// Half areas are scaled once, so that they neither overflow nor vanish.
struct Scale {
    explicit Scale(const Bounds& bounds, size_t triangles) : factor(scale_of(bounds)) {
        const float all = half_area((bounds.upper - bounds.lower) * factor);
        if (factor > 0) largest = std::min(kMost, kLargest * all / factor / float(triangles));
    }
    Floats half_areas(const Axes& sizes) const {
        const Floats x = sizes.x * factor;
        return min(x * sizes.y + (x + sizes.y * factor) * sizes.z, Floats{} + kMost);
    }

    float factor;
    float largest = kMost; // half area of a cluster
};

Floats common_size(const Reference& a, const Reference& b) {
    const Bounds first = a.bounds(), second = b.bounds();
    return max(first.upper, second.upper) - min(first.lower, second.lower);
}

class Chunk {
public:
    Chunk(const Task& task, const MortonKey* keys, uint32_t count, Scratch& scratch)
        : triangles_(task.triangles), keys_(keys), count_(count), items_(count), s_(scratch) {
        for (uint32_t i = 0; i < count; ++i) {
            __builtin_prefetch(triangles_ + keys[std::min(i + kAhead, count - 1)].item);
            s_.items[i].set(i, bounds_of(triangles_[keys[i].item]));
        }
    }

    void join_all(const Scale& scale) {
        for (uint32_t round = 0; round < kMaxRounds && items_ > 1 + count_ / kEnough; ++round) {
            const uint32_t pairs = find_pairs(scale);
            if (pairs * kFewPairs < items_) return;
            join(pairs);
        }
    }

    void write(uint32_t first_member, Members& members, Clusters& to) {
        members_ = &members;
        next_member_ = first_member;
        to.nodes.reserve(nodes_ + items_);
        to.roots.reserve(items_);
        for (uint32_t i = 0; i < items_; ++i) {
            const Reference& item = s_.items[i];
            to.roots.push_back(
                Reference::make(uint32_t(to.nodes.size()), item.bounds(), item.weight()));
            add(item.triangle(), to.nodes);
        }
    }

private:
    // Keys of an item and the next one: the half area of their common box. The last bit makes pairs
    // of what is all the same.
    void find_keys(const Scale& scale) {
        for (uint32_t i = items_; i <= items_ + kLanes; ++i) s_.items[i].set(0, {-kNone, kNone});
        for (uint32_t i = 0; i < items_; i += kLanes) {
            const Reference* const item = s_.items + i;
            const Floats areas = scale.half_areas(
                transpose(common_size(item[0], item[1]), common_size(item[1], item[2]),
                          common_size(item[2], item[3]), common_size(item[3], item[4])));
            const Ints keys = (std::bit_cast<Ints>(areas) & ~1) | Ints{0, 1, 0, 1};
            std::memcpy(s_.keys + i, &keys, sizeof keys);
        }
        s_.keys[items_ - 1] = std::numeric_limits<int32_t>::max();
    }

    // Of items that are each other's better neighbour. The second is not kept.
    uint32_t find_pairs(const Scale& scale) {
        find_keys(scale);
        const int32_t* const keys = s_.keys;
        const int32_t largest = std::bit_cast<int32_t>(scale.largest) | 1;
        uint32_t* first = s_.firsts;
        uint32_t* kept = s_.kept;
        int32_t before = std::numeric_limits<int32_t>::max();
        bool second = false;
        for (uint32_t i = 0, end = items_; i < end; ++i) { // without a branch
            const bool joined = (keys[i] < before) & (keys[i] < keys[i + 1]) & (keys[i] <= largest);
            before = keys[i];
            *first = *kept = i;
            first += joined;
            kept += !second;
            second = joined;
        }
        return uint32_t(first - s_.firsts);
    }

    void join(uint32_t pairs) {
        Reference* const items = s_.items;
        for (uint32_t pair = 0; pair < pairs; ++pair) {
            const uint32_t place = s_.firsts[pair];
            Reference& first = items[place];
            const Reference& second = items[place + 1];
            Bounds bounds = first.bounds();
            bounds.extend(second.bounds());
            const uint32_t weight = first.weight() + second.weight();
            const uint32_t number = nodes_ + pair;
            s_.nodes[number].set(bounds, first.triangle(), second.triangle());
            s_.weights[number] = weight;
            first.set(kChunk + number, bounds, weight);
        }
        nodes_ += pairs;
        items_ -= pairs;
        for (uint32_t i = 0; i < items_; ++i) items[i] = items[s_.kept[i]];
    }

    // Adds an item's nodes; what fits in a block becomes a leaf.
    void add(uint32_t item, base::Vector<BinaryNode>& to) {
        const uint32_t place = uint32_t(to.size());
        BinaryNode& added = to.emplace_back();
        if (item < kChunk) {
            added.set(bounds_of(triangles_[keys_[item].item]), next_member_, BinaryNode::kLeaf | 1);
            return add_members(item);
        }
        const BinaryNode& node = s_.nodes[item - kChunk];
        const uint32_t weight = s_.weights[item - kChunk];
        added.set(node.bounds(), next_member_, BinaryNode::kLeaf | weight);
        if (weight <= kBlockWidth) return add_members(item);
        added.first = place + 1;
        add(node.first, to);
        to[place].second = uint32_t(to.size());
        add(node.second, to);
    }

    void add_members(uint32_t item) {
        if (item < kChunk) {
            const uint32_t number = keys_[item].item;
            members_->numbers[next_member_] = number;
            members_->triangles[next_member_++] = triangles_[number];
            return;
        }
        add_members(s_.nodes[item - kChunk].first);
        add_members(s_.nodes[item - kChunk].second);
    }

    const geometry::Triangle* triangles_;
    const MortonKey* keys_;
    uint32_t count_;
    uint32_t items_;
    uint32_t nodes_ = 0;
    Members* members_ = nullptr;
    uint32_t next_member_ = 0;
    Scratch& s_;
};

} // namespace

base::Vector<Clusters> agglomerate(const Task& task, std::span<const MortonKey> keys,
                                   const Bounds& bounds, base::Scheduler& scheduler,
                                   Members& members) {
    const Scale scale(bounds, keys.size());
    const uint32_t chunks = uint32_t((keys.size() + kChunk - 1) / kChunk);
    base::Vector<Clusters> result(task.memory);
    members.triangles.allocate(keys.size());
    members.numbers.allocate(keys.size());
    result.reserve(chunks);
    for (uint32_t i = 0; i < chunks; ++i) result.emplace_back(task.memory);
    scheduler.for_each((chunks + kChunksPerTask - 1) / kChunksPerTask, [&](uint32_t t) {
        if (task.control.cancelled()) return;
        Buffer<Scratch> scratch(task.memory);
        scratch.allocate(1);
        for (uint32_t i = t * kChunksPerTask; i < std::min(chunks, (t + 1) * kChunksPerTask); ++i) {
            const uint32_t begin = i * kChunk;
            Chunk chunk(task, keys.data() + begin,
                        uint32_t(std::min<size_t>(kChunk, keys.size() - begin)), scratch[0]);
            chunk.join_all(scale);
            chunk.write(begin, members, result[i]);
        }
    });
    task.control.throw_if_cancelled();
    return result;
}

} // namespace peregrine::accel::bvh
