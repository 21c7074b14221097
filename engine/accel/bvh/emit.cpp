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

// What leaves of the binary tree refer to: triangle_of(i) for all i in them says where at() and
// number_of() find the triangle.
struct ListedTriangles {
    static constexpr bool kCut = true; // some may come more than once
    const geometry::Triangle* triangles;
    const Reference* references;

    uint32_t triangle_of(uint32_t i) const { return references[i].triangle(); }
    const geometry::Triangle& at(uint32_t triangle) const { return triangles[triangle]; }
    uint32_t number_of(uint32_t triangle) const { return triangle; }
};
struct CopiedTriangles {
    static constexpr bool kCut = false;
    const Members& members;

    uint32_t triangle_of(uint32_t i) const { return i; }
    const geometry::Triangle& at(uint32_t triangle) const { return members.triangles[triangle]; }
    uint32_t number_of(uint32_t triangle) const { return members.numbers[triangle]; }
};

template <class Source>
class Emitter {
public:
    Emitter(const BinaryTree& binary, const Source& source, const WideTree& wide,
            base::Memory* memory, Tree& tree)
        : binary_(binary.nodes), source_(source), wide_(wide), tree_(tree), shares_(memory),
          triangles_(memory) {}

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
        Bounds boxes[kWidth];
        for (uint32_t i = 0; i < wide.count; ++i) boxes[i] = binary_[wide.children[i]].bounds();
        for (uint32_t i = 0; i < kWidth; i += 4) {
            const Bounds* const box = boxes + i;
            write_axes(transpose(box[0].lower, box[1].lower, box[2].lower, box[3].lower), i,
                       node.lower);
            write_axes(transpose(box[0].upper, box[1].upper, box[2].upper, box[3].upper), i,
                       node.upper);
        }
        std::fill_n(node.child, kWidth, Link{0});
    }
    template <size_t width>
    static void write_axes(const Axes& axes, uint32_t first, float (&to)[3][width]) {
        store4(axes.x, to[0] + first);
        store4(axes.y, to[1] + first);
        store4(axes.z, to[2] + first);
    }

    // Triangles of a leaf, once each: several parts of one may have come together.
    uint32_t gather(const WideNode& wide, uint32_t place) {
        uint32_t* first = triangles_.data() + (wide.targets[place] & ~Link::kLeaf);
        uint32_t* last = first;
        add_triangles(wide.children[place], last);
        if constexpr (Source::kCut) {
            std::sort(first, last);
            last = std::unique(first, last);
        }
        return uint32_t(last - first);
    }
    void add_triangles(uint32_t binary, uint32_t*& last) const {
        const BinaryNode& node = binary_[binary];
        if (!node.is_leaf()) {
            add_triangles(node.first, last);
            add_triangles(node.second, last);
            return;
        }
        for (uint32_t i = 0; i < node.count(); ++i) *last++ = source_.triangle_of(node.first + i);
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
        Floats corners[3][kBlockWidth];
        for (uint32_t lane = 0; lane < kBlockWidth; ++lane) {
            const uint32_t triangle = triangles[std::min(lane, count - 1)];
            block.triangle[lane] = source_.number_of(triangle);
            for (uint32_t i = 0; i < 3; ++i) corners[i][lane] = vertex_of(source_.at(triangle), i);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            const Floats* const corner = corners[i];
            write_axes(transpose(corner[0], corner[1], corner[2], corner[3]), 0, block.vertex[i]);
        }
    }

    const base::Vector<BinaryNode>& binary_;
    Source source_;
    const WideTree& wide_;
    Tree& tree_;
    base::Vector<Share> shares_;
    Buffer<uint32_t> triangles_; // leaf after leaf
};

} // namespace

void emit(const Task& task, const BinaryTree& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree) {
    Emitter(binary, ListedTriangles{task.triangles, references}, wide, task.memory, tree)
        .run(scheduler);
}

void emit(const Task& task, const BinaryTree& binary, const Members& members, const WideTree& wide,
          base::Scheduler& scheduler, Tree& tree) {
    Emitter(binary, CopiedTriangles{members}, wide, task.memory, tree).run(scheduler);
}

} // namespace peregrine::accel::bvh
