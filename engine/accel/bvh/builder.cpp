#include "accel/bvh/builder.h"

#include "accel/bvh/cluster_tree.h"
#include "accel/bvh/collapse.h"
#include "accel/bvh/effort.h"
#include "accel/bvh/emit.h"
#include "accel/bvh/reinsertion.h"
#include "accel/bvh/top_down.h"

#include <chrono>
#include <cmath>

namespace peregrine::accel::bvh {
namespace {

constexpr uint64_t kMaxBlocks = uint64_t(1) << 26; // as a link can say

BinaryTree build_tree(Task& task, std::span<const geometry::Triangle> triangles,
                      base::Scheduler& scheduler, Arena& arena) {
    const uint32_t count = uint32_t(triangles.size());
    arena.allocate(count + uint32_t(double(count) * task.effort.duplicates));
    Range root{};
    root.extent = make_references(triangles, scheduler, task.memory, arena.data());
    root.end = count;
    root.slots_end = arena.capacity();
    const Bounds& bounds = root.extent.bounds;
    task.root_scale = scale_of(bounds);
    task.least_overlap = kOverlapOfRoot / std::sqrt(float(count))
                         * half_area((bounds.upper - bounds.lower) * task.root_scale);
    BinaryTree tree = build_top_down(task, arena, root, scheduler);
    reinsert(task, scheduler, tree);
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

    Arena arena(memory);
    Members members(memory);
    const bool fast = options.quality == Quality::fast;
    const BinaryTree binary = fast ? build_cluster_tree(task, triangles, scheduler, members)
                                   : build_tree(task, triangles, scheduler, arena);
    const WideTree wide = make_wide(task, options, binary, uint32_t(triangles.size()), scheduler);
    if (wide.blocks > kMaxBlocks)
        base::fail(base::Code::limit, "the BVH would have more than %llu blocks of triangles",
                   static_cast<unsigned long long>(kMaxBlocks));
    if (fast)
        emit(task, binary, members, wide, scheduler, tree);
    else
        emit(task, binary, arena.data(), wide, scheduler, tree);

    tree.bounds = binary.nodes[0].bounds().box();
    tree.report.sah_cost = wide.cost / double(options.intersection_cost);
    tree.report.max_depth = wide.depth;
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    tree.report.build_ms = elapsed.count();
    return tree;
}

} // namespace peregrine::accel::bvh
