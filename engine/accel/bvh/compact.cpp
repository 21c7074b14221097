#include "accel/bvh/compact.h"

#include "accel/bvh/quantise.h"
#include "base/error.h"

#include <algorithm>
#include <cstring>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kNodesPerTask = 512;

uint32_t count_children(const Node& node) {
    uint32_t count = 0;
    while (count < kWidth && node.lower[0][count] <= node.upper[0][count]) ++count;
    return count;
}

// The vertices of some leaves of a node, by bits.
class Pool {
public:
    // The corners of a leaf's triangles, or false if there is no room for all of them.
    bool add(const Block* blocks, uint32_t count, uint8_t (*corners)[3]) {
        const uint32_t size = size_;
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t corner = 0; corner < 3; ++corner)
                if (!find(blocks[i / kBlockWidth], corner, i % kBlockWidth, corners[i][corner])) {
                    size_ = size;
                    return false;
                }
        return true;
    }
    void clear() { size_ = 0; }

    uint32_t units() const {
        return uint32_t((size_ * sizeof *vertices_ + sizeof(LeafUnit) - 1) / sizeof(LeafUnit));
    }
    void write(LeafUnit* out) const { std::memcpy(out, vertices_, size_ * sizeof *vertices_); }

private:
    bool find(const Block& block, uint32_t corner, uint32_t lane, uint8_t& place) {
        float vertex[3];
        for (uint32_t axis = 0; axis < 3; ++axis) vertex[axis] = block.vertex[corner][axis][lane];
        uint32_t i = 0;
        while (i < size_ && std::memcmp(vertices_[i], vertex, sizeof vertex) != 0) ++i;
        if (i == LeafRecord::kMostVertices) return false;
        if (i == size_) std::memcpy(vertices_[size_++], vertex, sizeof vertex);
        place = uint8_t(i);
        return true;
    }

    uint32_t size_ = 0;
    float vertices_[LeafRecord::kMostVertices][3];
};
static_assert(LeafRecord::kMostVertices >= 3 * kMaxLeaf);

class Compactor {
public:
    Compactor(const Tree& full, base::Memory* memory)
        : full_(full), shares_(memory), tree_(memory) {}

    CompactTree run(base::Scheduler& scheduler) {
        const auto count = uint32_t(full_.nodes.size());
        const uint32_t tasks = (count + kNodesPerTask - 1) / kNodesPerTask;
        tree_.nodes.resize(count);
        shares_.resize(tasks);
        scheduler.for_each(tasks, [&](uint32_t i) { write(i); });
        uint64_t units = 0;
        for (const Units& share : shares_) units += share.size();
        if (units > Link::kLeaf)
            base::fail(base::Code::limit,
                       "the leaves of a compact BVH would have more than 16 GiB");
        tree_.leaves.resize(units);
        join();
        return std::move(tree_);
    }

private:
    using Units = base::Vector<LeafUnit>;

    uint32_t end_of(uint32_t task) const {
        return std::min(uint32_t(tree_.nodes.size()), (task + 1) * kNodesPerTask);
    }

    // Leaves are counted from the task's first unit.
    void write(uint32_t task) {
        for (uint32_t i = task * kNodesPerTask; i < end_of(task); ++i) {
            const Node& node = full_.nodes[i];
            CompactNode& out = tree_.nodes[i];
            const uint32_t children = count_children(node);
            quantise(node, children, out);
            std::copy_n(node.child, kWidth, out.child);
            std::copy_n(node.order, 4, out.order);
            out.there = (1u << children) - 1;
            write_leaves(out, shares_[task]);
        }
    }

    // All pools, then all records.
    void write_leaves(CompactNode& node, Units& units) {
        uint8_t corners[kWidth][kMaxLeaf][3];
        size_t pool_of[kWidth];
        Pool pool;
        const auto close = [&] {
            if (pool.units() == 0) return;
            const size_t begin = units.size();
            units.resize(begin + pool.units());
            pool.write(units.data() + begin);
            pool.clear();
        };
        for (uint32_t i = 0; i < kWidth; ++i) {
            const Link link = node.child[i];
            if (!link.is_leaf()) continue;
            const Block* blocks = &full_.blocks[link.first_block()];
            if (!pool.add(blocks, link.count(), corners[i])) {
                close();
                pool.add(blocks, link.count(), corners[i]);
            }
            pool_of[i] = units.size();
        }
        close();
        for (uint32_t i = 0; i < kWidth; ++i)
            if (node.child[i].is_leaf())
                node.child[i] = write_record(node.child[i], corners[i], pool_of[i], units);
    }

    Link write_record(Link leaf, const uint8_t (*corners)[3], size_t pool, Units& units) const {
        const size_t begin = units.size();
        const uint32_t count = leaf.count();
        units.resize(begin + LeafRecord::units(count));
        auto* out = reinterpret_cast<std::byte*>(units.data() + begin);
        const LeafRecord record{uint32_t(begin - pool) << LeafRecord::kCountBits | count};
        std::memcpy(out, &record, sizeof record);
        out += sizeof record;
        for (uint32_t first = 0; first < count; first += kBlockWidth, out += sizeof(LeafGroup)) {
            const Block& block = full_.blocks[leaf.first_block() + first / kBlockWidth];
            LeafGroup group;
            for (uint32_t lane = 0; lane < kBlockWidth; ++lane) {
                const uint8_t* triangle = corners[std::min(first + lane, count - 1)];
                for (uint32_t corner = 0; corner < 3; ++corner)
                    group.vertex[corner][lane] = triangle[corner];
                group.triangle[lane] = block.triangle[lane];
            }
            std::memcpy(out, &group, sizeof group);
        }
        return {Link::kLeaf | uint32_t(begin)};
    }

    void join() {
        size_t begin = 0;
        for (uint32_t task = 0; task < shares_.size(); ++task) {
            const Units& share = shares_[task];
            std::copy(share.begin(), share.end(), tree_.leaves.begin() + std::ptrdiff_t(begin));
            for (uint32_t i = task * kNodesPerTask; i < end_of(task); ++i)
                for (Link& link : tree_.nodes[i].child)
                    if (link.is_leaf()) link.bits += uint32_t(begin);
            begin += share.size();
        }
    }

    const Tree& full_;
    base::Vector<Units> shares_;
    CompactTree tree_;
};

} // namespace

CompactTree compact(const Tree& tree, base::Scheduler& scheduler, base::Memory* memory) {
    if (tree.nodes.empty()) return CompactTree(memory);
    return Compactor(tree, memory).run(scheduler);
}

} // namespace peregrine::accel::bvh
