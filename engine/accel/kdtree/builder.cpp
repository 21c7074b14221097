#include "accel/kdtree/builder.h"

#include "accel/kdtree/assemble.h"
#include "accel/kdtree/builder_pool.h"
#include "accel/kdtree/root.h"
#include "accel/kdtree/top_levels.h"
#include "accel/subtrees.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace peregrine::accel::kdtree {
namespace {

// As pbrt's, which takes it from Havran's thesis.
uint32_t depth_limit(size_t triangles) {
    const double wanted = 8 + 1.3 * std::log2(double(std::max<size_t>(1, triangles)));
    return std::min(kMaxDepth, uint32_t(wanted));
}

base::Vector<Subtree> build_subtrees(const Task& task, base::Vector<TopNode>& top,
                                     base::Scheduler& scheduler) {
    base::Vector<uint32_t> roots(task.memory); // among the top nodes
    for (uint32_t i = 0; i < top.size(); ++i)
        if (!top[i].is_inner()) roots.push_back(i);
    base::Vector<Subtree> subtrees(task.memory);
    subtrees.reserve(top.size());
    for (size_t i = 0; i < top.size(); ++i) subtrees.emplace_back(task.memory);
    BuilderPool pool(task);
    accel::build_subtrees(
        uint32_t(roots.size()), [&](uint32_t i) { return top[roots[i]].lists.triangles; },
        [&](uint32_t i) {
            TopNode& root = top[roots[i]];
            BuilderPool::Lease builder(pool);
            builder->build(std::move(root.lists), root.place, subtrees[roots[i]]);
        },
        TopLevels::kShareOfTime, task.control, scheduler, task.memory);
    return subtrees;
}

void write_report(const Statistics& statistics, const Task& task, Tree& tree) {
    const double area = math::half_area(tree.bounds);
    BuildReport& report = tree.report;
    report.sah_cost = area > 0 ? statistics.cost / area / task.model.intersection
                               : double(tree.references.size());
    report.max_depth = statistics.max_depth;
    report.depth_limit = task.depth_limit;
    report.leaves = statistics.leaves;
    report.empty_leaves = statistics.empty_leaves;
    report.largest_leaf = statistics.largest_leaf;
}

} // namespace

Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory) {
    const auto start = std::chrono::steady_clock::now();
    if (triangles.size() > kMaxTriangles)
        base::fail(base::Code::limit, "a kd-tree holds at most %llu triangles, not %llu",
                   static_cast<unsigned long long>(kMaxTriangles),
                   static_cast<unsigned long long>(triangles.size()));
    Control control(progress);
    const Task task{triangles.data(),
                    {double(options.traversal_cost), double(options.intersection_cost),
                     1 - double(options.empty_bonus)},
                    depth_limit(triangles.size()),
                    control,
                    memory};
    Tree tree(memory);
    OwnedLists root(memory);
    if (control.report(0)) control.throw_if_cancelled();
    if (triangles.empty()) {
        tree.nodes.push_back(Node::leaf(0, 0));
        tree.report.leaves = tree.report.empty_leaves = 1;
        return tree;
    }
    make_root(triangles, scheduler, memory, root, tree.bounds);
    base::Vector<TopNode> top = TopLevels(task, scheduler).build(std::move(root), tree.bounds);
    control.throw_if_cancelled();
    const base::Vector<Subtree> subtrees = build_subtrees(task, top, scheduler);
    const Statistics statistics = assemble(top, subtrees, task.model, scheduler, tree);
    write_report(statistics, task, tree);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    tree.report.build_ms = elapsed.count();
    return tree;
}

} // namespace peregrine::accel::kdtree
