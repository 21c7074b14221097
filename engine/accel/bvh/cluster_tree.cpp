#include "accel/bvh/cluster_tree.h"

#include "accel/bvh/top_down.h"

namespace peregrine::accel::bvh {
namespace {

// The fewer there are, the coarser their order may be: two passes of sorting instead of three.
uint32_t morton_bits_for(size_t triangles) {
    return triangles <= 1u << 18 ? 7 : kMaxMortonBits;
}

// All clusters, as references by the number of their root among all nodes of clusters.
Range list_clusters(const base::Vector<Clusters>& parts, Arena& arena) {
    size_t count = 0;
    for (const Clusters& part : parts) count += part.roots.size();
    arena.allocate(uint32_t(count));
    Range all{};
    all.end = all.slots_end = uint32_t(count);
    Reference* next = arena.data();
    uint32_t nodes = 0;
    for (const Clusters& part : parts) {
        for (const Reference& root : part.roots) {
            next->set(nodes + root.triangle(), root.bounds(), root.weight());
            all.extent.extend(*next++);
        }
        nodes += uint32_t(part.nodes.size());
    }
    return all;
}

// Puts clusters where the tree has leaves for them. A cluster's root is copied there, and its own
// place is not used.
void add_clusters(const base::Vector<Clusters>& parts, const Arena& arena,
                  base::Scheduler& scheduler, BinaryTree& tree) {
    const uint32_t top = uint32_t(tree.nodes.size());
    uint32_t end = top;
    tree.parts.clear();
    tree.parts.reserve(parts.size());
    for (const Clusters& part : parts) {
        const uint32_t begin = std::exchange(end, end + uint32_t(part.nodes.size()));
        tree.parts.push_back({begin, end});
    }
    tree.nodes.resize(end);
    scheduler.for_each(uint32_t(parts.size()), [&](uint32_t i) {
        const uint32_t begin = tree.parts[i].begin;
        BinaryNode* to = tree.nodes.data() + begin;
        for (const BinaryNode& node : parts[i].nodes) {
            *to = node;
            if (!node.is_leaf()) to->first += begin, to->second += begin;
            ++to;
        }
    });
    for (uint32_t i = 0; i < top; ++i) {
        BinaryNode& node = tree.nodes[i];
        if (node.is_leaf()) node = tree.nodes[top + arena.data()[node.first].triangle()];
    }
}

} // namespace

BinaryTree build_cluster_tree(Task& task, std::span<const geometry::Triangle> triangles,
                              base::Scheduler& scheduler, Members& members) {
    const Extent extent = extent_of(triangles, scheduler, task.memory);
    const Buffer<MortonKey> keys = sort_along_morton_curve(
        triangles, extent.centers, morton_bits_for(triangles.size()), scheduler, task.memory);
    const base::Vector<Clusters> clusters =
        agglomerate(task, {keys.data(), triangles.size()}, extent.bounds, scheduler, members);
    Arena arena(task.memory);
    const Range root = list_clusters(clusters, arena);
    task.depth_limit = kMaxBinaryDepth - kMaxRounds;
    BinaryTree tree = build_top_down(task, arena, root, scheduler);
    add_clusters(clusters, arena, scheduler, tree);
    return tree;
}

} // namespace peregrine::accel::bvh
