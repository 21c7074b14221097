#include "accel/bvh/emit.h"

#include <algorithm>
#include <limits>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kNodesPerTask = 256;

struct Leaf {
    uint32_t triangles[kMaxLeaf];
    uint32_t count = 0;
};

void gather(const base::Vector<BinaryNode>& binary, const Reference* references, uint32_t index,
            Leaf& leaf) {
    const BinaryNode& node = binary[index];
    if (!node.is_leaf()) {
        gather(binary, references, node.first, leaf);
        gather(binary, references, node.second, leaf);
        return;
    }
    for (uint32_t i = 0; i < node.count(); ++i)
        leaf.triangles[leaf.count++] = references[node.first + i].triangle();
}

void write_blocks(const geometry::Triangle* triangles, const Leaf& leaf, Block* blocks) {
    for (uint32_t i = 0; i < (leaf.count + kBlockWidth - 1) / kBlockWidth * kBlockWidth; ++i) {
        const uint32_t index = leaf.triangles[std::min(i, leaf.count - 1)];
        const geometry::Triangle& triangle = triangles[index];
        Block& block = blocks[i / kBlockWidth];
        const uint32_t lane = i % kBlockWidth;
        for (int axis = 0; axis < 3; ++axis) {
            block.vertex[0][axis][lane] = triangle.v0[axis];
            block.vertex[1][axis][lane] = triangle.v1[axis];
            block.vertex[2][axis][lane] = triangle.v2[axis];
        }
        block.triangle[lane] = index;
    }
}

// By how far the children's middles are along the octant's diagonal.
uint32_t order_of(const Node& node, uint32_t count, uint32_t octant) {
    double key[kWidth];
    uint32_t places[kWidth];
    for (uint32_t i = 0; i < kWidth; ++i) {
        places[i] = i;
        key[i] = std::numeric_limits<double>::infinity();
        if (i >= count) continue;
        key[i] = 0;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const double middle = double(node.lower[axis][i]) + double(node.upper[axis][i]);
            key[i] += (octant >> axis & 1) != 0 ? -middle : middle;
        }
    }
    std::sort(places, places + kWidth,
              [&](uint32_t a, uint32_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
    uint32_t order = 0;
    for (uint32_t i = 0; i < kWidth; ++i) order |= places[i] << 3 * i;
    return order;
}

void write_node(const base::Vector<BinaryNode>& binary, const WideNode& wide, Node& node) {
    for (uint32_t i = 0; i < kWidth; ++i) {
        const math::Box box = i < wide.count ? binary[wide.children[i]].box() : math::Box{};
        for (int axis = 0; axis < 3; ++axis) {
            node.lower[axis][i] = box.lower[axis];
            node.upper[axis][i] = box.upper[axis];
        }
        node.child[i] = i < wide.count ? Link{wide.links[i]} : Link{0};
    }
    for (uint32_t octant = 0; octant < 8; ++octant)
        node.order[octant] = order_of(node, wide.count, octant);
}

} // namespace

void emit(const Task& task, const base::Vector<BinaryNode>& binary, const Reference* references,
          const WideTree& wide, base::Scheduler& scheduler, Tree& tree) {
    tree.nodes.resize(wide.nodes.size());
    tree.blocks.resize(wide.blocks);
    const uint32_t count = uint32_t(wide.nodes.size());
    scheduler.for_each((count + kNodesPerTask - 1) / kNodesPerTask, [&](uint32_t chunk) {
        const uint32_t end = std::min(count, (chunk + 1) * kNodesPerTask);
        for (uint32_t i = chunk * kNodesPerTask; i < end; ++i) {
            const WideNode& node = wide.nodes[i];
            write_node(binary, node, tree.nodes[i]);
            for (uint32_t k = 0; k < node.count; ++k) {
                const Link link{node.links[k]};
                if (!link.is_leaf()) continue;
                Leaf leaf;
                gather(binary, references, node.children[k], leaf);
                write_blocks(task.triangles, leaf, tree.blocks.data() + link.first_block());
            }
        }
    });
    for (const WideNode& node : wide.nodes) {
        for (uint32_t k = 0; k < node.count; ++k) {
            const Link link{node.links[k]};
            if (!link.is_leaf()) continue;
            ++tree.report.leaves;
            tree.report.references += link.count();
            tree.report.largest_leaf = std::max<uint64_t>(tree.report.largest_leaf, link.count());
        }
    }
}

} // namespace peregrine::accel::bvh
