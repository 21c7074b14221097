#include "accel/bvh/emit.h"

#include "accel/buffer.h"
#include "accel/bvh/front_to_back.h"

#include <algorithm>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kNodesPerTask = 512;

// What a task's nodes have.
struct Share {
    uint64_t leaves = 0;
    uint64_t references = 0;
    uint64_t largest_leaf = 0;
    uint32_t blocks = 0;
    uint32_t first_block = 0;
};

class Emitter {
public:
    Emitter(const Task& task, const BinaryTree& binary, const Reference* references,
            const WideTree& wide, Tree& tree)
        : task_(task), binary_(binary.nodes), references_(references), wide_(wide), tree_(tree),
          shares_(task.memory), triangles_(task.memory) {}

    void run(base::Scheduler& scheduler) {
        const uint32_t tasks = uint32_t((wide_.nodes.size() + kNodesPerTask - 1) / kNodesPerTask);
        shares_.resize(tasks);
        triangles_.allocate(wide_.references);
        tree_.nodes.resize(wide_.nodes.size());
        scheduler.for_each(tasks, [&](uint32_t i) { write_nodes(i); });
        uint32_t blocks = 0;
        for (Share& share : shares_) {
            share.first_block = blocks;
            blocks += share.blocks;
            tree_.report.leaves += share.leaves;
            tree_.report.references += share.references;
            tree_.report.largest_leaf = std::max(tree_.report.largest_leaf, share.largest_leaf);
        }
        tree_.blocks.resize(blocks);
        scheduler.for_each(tasks, [&](uint32_t i) { write_blocks(i); });
    }

private:
    uint32_t end_of(uint32_t task) const {
        return uint32_t(std::min<uint64_t>(wide_.nodes.size(), uint64_t(task + 1) * kNodesPerTask));
    }

    // Blocks are counted from the task's first.
    void write_nodes(uint32_t task) {
        Share& share = shares_[task];
        for (uint32_t i = task * kNodesPerTask; i < end_of(task); ++i) {
            const WideNode& wide = wide_.nodes[i];
            Node& node = tree_.nodes[i];
            write_boxes(wide, node);
            for (uint32_t k = 0; k < wide.count; ++k) {
                node.child[k] = Link{wide.targets[k]};
                if (!node.child[k].is_leaf()) continue;
                const uint32_t count = gather(wide, k);
                node.child[k] = Link::leaf(share.blocks, count);
                share.blocks += (count + kBlockWidth - 1) / kBlockWidth;
                share.references += count;
                share.largest_leaf = std::max<uint64_t>(share.largest_leaf, count);
                ++share.leaves;
            }
            sort_front_to_back(node, wide.count);
        }
    }

    void write_boxes(const WideNode& wide, Node& node) const {
        for (uint32_t i = 0; i < kWidth; ++i) {
            const math::Box box =
                i < wide.count ? binary_[wide.children[i]].bounds().box() : math::Box{};
            for (int axis = 0; axis < 3; ++axis) {
                node.lower[axis][i] = box.lower[axis];
                node.upper[axis][i] = box.upper[axis];
            }
            node.child[i] = Link{0};
        }
    }

    // Triangles of a leaf, in order and once each: several parts of one may have come together.
    uint32_t gather(const WideNode& wide, uint32_t place) {
        uint32_t* first = triangles_.data() + (wide.targets[place] & ~Link::kLeaf);
        uint32_t* last = first;
        add_triangles(wide.children[place], last);
        std::sort(first, last);
        return uint32_t(std::unique(first, last) - first);
    }
    void add_triangles(uint32_t binary, uint32_t*& last) const {
        const BinaryNode& node = binary_[binary];
        if (!node.is_leaf()) {
            add_triangles(node.first, last);
            add_triangles(node.second, last);
            return;
        }
        for (uint32_t i = 0; i < node.count(); ++i)
            *last++ = references_[node.first + i].triangle();
    }

    void write_blocks(uint32_t task) {
        const uint32_t first_block = shares_[task].first_block;
        for (uint32_t i = task * kNodesPerTask; i < end_of(task); ++i) {
            const WideNode& wide = wide_.nodes[i];
            for (uint32_t k = 0; k < wide.count; ++k) {
                Link& link = tree_.nodes[i].child[k];
                if (!link.is_leaf()) continue;
                link = Link::leaf(first_block + link.first_block(), link.count());
                const uint32_t first = wide.targets[k] & ~Link::kLeaf;
                for (uint32_t lane = 0; lane < link.count(); lane += kBlockWidth)
                    write_block(triangles_.data() + first + lane, link.count() - lane,
                                tree_.blocks[link.first_block() + lane / kBlockWidth]);
            }
        }
    }

    void write_block(const uint32_t* triangles, uint32_t count, Block& block) const {
        for (uint32_t lane = 0; lane < kBlockWidth; ++lane) {
            const uint32_t index = triangles[std::min(lane, count - 1)];
            const geometry::Triangle& triangle = task_.triangles[index];
            for (int axis = 0; axis < 3; ++axis) {
                block.vertex[0][axis][lane] = triangle.v0[axis];
                block.vertex[1][axis][lane] = triangle.v1[axis];
                block.vertex[2][axis][lane] = triangle.v2[axis];
            }
            block.triangle[lane] = index;
        }
    }

    const Task& task_;
    const base::Vector<BinaryNode>& binary_;
    const Reference* references_;
    const WideTree& wide_;
    Tree& tree_;
    base::Vector<Share> shares_;
    Buffer<uint32_t> triangles_; // leaf after leaf
};

} // namespace

void emit(const Task& task, const BinaryTree& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree) {
    Emitter(task, binary, references, wide, tree).run(scheduler);
}

} // namespace peregrine::accel::bvh
