#include "accel/bvh/builder.h"

#include "accel/bvh/clusters.h"
#include "accel/bvh/collapse.h"
#include "accel/bvh/effort.h"
#include "accel/bvh/emit.h"
#include "accel/bvh/reinsertion.h"
#include "accel/bvh/subtree.h"
#include "accel/bvh/top_levels.h"
#include "accel/subtrees.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace peregrine::accel::bvh {
namespace {

constexpr uint64_t kMaxBlocks = uint64_t(1) << 26; // as a link can say

Range make_root(std::span<const geometry::Triangle> triangles, Task& task,
                base::Scheduler& scheduler, Arena& arena, Clusters& clusters) {
    uint32_t count = uint32_t(triangles.size());
    Range root{};
    if (task.effort.clusters) {
        Buffer<Reference> references(task.memory);
        references.allocate(count);
        const Extent extent = make_references(triangles, scheduler, task.memory, references.data());
        make_clusters(task, references.data(), count, extent, scheduler, clusters);
        task.members = clusters.members.data();
        task.depth_limit = kMaxBinaryDepth - kClusterDepth;
        count = uint32_t(clusters.groups.size());
        arena.allocate(count);
        std::copy(clusters.groups.begin(), clusters.groups.end(), arena.data());
        root.extent = extent_of(clusters.groups);
    } else {
        arena.allocate(count + uint32_t(double(count) * task.effort.duplicates));
        root.extent = make_references(triangles, scheduler, task.memory, arena.data());
    }
    root.end = count;
    root.slots_end = arena.capacity();
    return root;
}

void build_subtrees(const Task& task, Arena& arena, base::Vector<Subtree>& subtrees,
                    base::Scheduler& scheduler) {
    accel::build_subtrees(
        uint32_t(subtrees.size()), [&](uint32_t i) { return subtrees[i].range.size(); },
        [&](uint32_t i) { build_subtree(task, arena, subtrees[i].range, subtrees[i].nodes); },
        kShareOfTop, task.control, scheduler, task.memory);
}

// A subtree's root goes where the top nodes have room for it, the rest to the end.
void join(base::Vector<Subtree>& subtrees, BinaryTree& tree) {
    size_t total = tree.nodes.size();
    for (const Subtree& subtree : subtrees) total += subtree.nodes.size() - 1;
    tree.nodes.reserve(total);
    for (Subtree& subtree : subtrees) {
        const uint32_t begin = uint32_t(tree.nodes.size());
        for (BinaryNode& node : subtree.nodes) {
            if (node.is_leaf()) continue;
            node.first += begin - 1;
            node.second += begin - 1;
        }
        tree.nodes[subtree.node] = subtree.nodes[0];
        tree.nodes.insert(tree.nodes.end(), subtree.nodes.begin() + 1, subtree.nodes.end());
        tree.parts.push_back({begin, uint32_t(tree.nodes.size())});
        base::Vector<BinaryNode>(tree.nodes.get_allocator()).swap(subtree.nodes);
    }
}

BinaryTree build_binary(const Task& task, Arena& arena, const Range& root,
                        base::Scheduler& scheduler) {
    BinaryTree tree(task.memory);
    base::Vector<Subtree> subtrees(task.memory);
    build_top(task, arena, root, scheduler, tree.nodes, subtrees);
    task.control.throw_if_cancelled();
    build_subtrees(task, arena, subtrees, scheduler);
    join(subtrees, tree);
    return tree;
}

// With the smallest of some penalties for memory that is enough.
WideTree make_wide(const Task& task, const BuildOptions& options, const BinaryTree& binary,
                   uint32_t triangles, base::Scheduler& scheduler) {
    constexpr float kPenalties[] = {0.25f, 0.75f, 2, 6};
    const double most_bytes = task.effort.bytes * triangles;
    for (float penalty : kPenalties) {
        const WideCosts costs{options.traversal_cost, options.intersection_cost,
                              penalty * options.intersection_cost * kBlockWidth / float(triangles)};
        Choices choices(binary, costs, task.memory);
        choices.compute(scheduler);
        WideTree wide = collapse(binary, choices, costs, task.memory);
        const double bytes =
            double(wide.nodes.size()) * sizeof(Node) + double(wide.blocks) * sizeof(Block);
        if (bytes <= most_bytes || penalty == kPenalties[3]) return wide;
    }
    base::fail(base::Code::internal, "a BVH was not made wide");
}

} // namespace

Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory) {
    const auto start = std::chrono::steady_clock::now();
    if (triangles.size() > kMaxTriangles)
        base::fail(base::Code::limit, "a BVH holds at most %llu triangles, not %llu",
                   static_cast<unsigned long long>(kMaxTriangles),
                   static_cast<unsigned long long>(triangles.size()));
    Control control(progress);
    Task task{triangles.data(), effort_for(options.quality), control, memory};
    Tree tree(memory);
    if (control.report(0)) control.throw_if_cancelled();
    if (triangles.empty()) return tree;

    const uint32_t count = uint32_t(triangles.size());
    Arena arena(memory);
    Clusters clusters(memory);
    Range root = make_root(triangles, task, scheduler, arena, clusters);
    const Bounds& bounds = root.extent.bounds;
    tree.bounds = bounds.box();
    task.root_scale = scale_of(bounds);
    task.least_overlap = kOverlapOfRoot / std::sqrt(float(count))
                         * half_area((bounds.upper - bounds.lower) * task.root_scale);

    BinaryTree binary = build_binary(task, arena, root, scheduler);
    reinsert(task, scheduler, binary);
    const WideTree wide = make_wide(task, options, binary, count, scheduler);
    if (wide.blocks > kMaxBlocks)
        base::fail(base::Code::limit, "the BVH would have more than %llu blocks of triangles",
                   static_cast<unsigned long long>(kMaxBlocks));
    emit(task, binary, task.members ? task.members : arena.data(), wide, scheduler, tree);

    tree.report.sah_cost = wide.cost / double(options.intersection_cost);
    tree.report.max_depth = wide.depth;
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    tree.report.build_ms = elapsed.count();
    return tree;
}

} // namespace peregrine::accel::bvh
