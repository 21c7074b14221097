#include "accel/bih/builder.h"

#include "accel/bih/morton.h"
#include "accel/bih/top_levels.h"
#include "accel/buffer.h"
#include "accel/subtrees.h"

#include <chrono>

namespace peregrine::accel::bih {
namespace {

constexpr uint64_t kMaxNodes = uint64_t(1) << 29; // as a link can say

void build_subtrees(const Task& task, base::Vector<Subtree>& subtrees, base::Scheduler& scheduler) {
    accel::build_subtrees(
        uint32_t(subtrees.size()), [&](uint32_t i) { return subtrees[i].range.size(); },
        [&](uint32_t i) { build_subtree(task, subtrees[i]); }, kShareOfTop, task.control, scheduler,
        task.memory);
}

// A subtree's root goes where the top nodes have room for it, the rest behind them. Its references
// are where its leaves say already.
void join(const Task& task, const base::Vector<Subtree>& subtrees, base::Scheduler& scheduler,
          Tree& tree) {
    base::Vector<uint32_t> begins(task.memory);
    begins.reserve(subtrees.capacity());
    size_t total = tree.nodes.size();
    size_t references = 0;
    for (const Subtree& subtree : subtrees) {
        begins.push_back(uint32_t(total));
        total += subtree.count - 1;
        references += subtree.range.size();
    }
    if (total > kMaxNodes)
        base::fail(base::Code::limit, "the BIH would have more than %llu nodes",
                   static_cast<unsigned long long>(kMaxNodes));
    tree.nodes.resize(total);
    tree.references.resize(references);
    scheduler.for_each(uint32_t(subtrees.size()), [&](uint32_t i) {
        const Subtree& subtree = subtrees[i];
        uint32_t to = subtree.slot;
        for (size_t k = 0; k < subtree.count; ++k) {
            Node node = subtree.nodes[k];
            if (!node.is_leaf()) node.move_child(begins[i] - 1);
            tree.nodes[to] = node;
            to = begins[i] + uint32_t(k);
        }
        for (uint32_t k = subtree.range.begin; k < subtree.range.end; ++k)
            tree.references[k] = task.references[k].triangle();
    });
}

void write_report(const base::Vector<Subtree>& subtrees, Statistics statistics,
                  const BuildOptions& options, Tree& tree) {
    for (const Subtree& subtree : subtrees) statistics.add(subtree.statistics);
    const double area = math::half_area(tree.bounds);
    BuildReport& report = tree.report;
    report.sah_cost = area > 0 ? statistics.cost / area / double(options.intersection_cost)
                               : double(tree.references.size());
    report.max_depth = statistics.max_depth;
    report.leaves = statistics.leaves;
    report.largest_leaf = statistics.largest_leaf;
}

} // namespace

Tree build(std::span<const geometry::Triangle> triangles, const BuildOptions& options,
           base::Scheduler& scheduler, const base::Progress& progress, base::Memory* memory) {
    const auto start = std::chrono::steady_clock::now();
    if (triangles.size() > kMaxTriangles)
        base::fail(base::Code::limit, "a BIH holds at most %llu triangles, not %llu",
                   static_cast<unsigned long long>(kMaxTriangles),
                   static_cast<unsigned long long>(triangles.size()));
    Control control(progress);
    Tree tree(memory);
    if (control.report(0)) control.throw_if_cancelled();
    if (triangles.empty()) return tree;

    Buffer<Reference> references(memory);
    references.allocate(triangles.size());
    Buffer<Node> nodes(memory);
    nodes.allocate(kNodesPerTriangle * triangles.size());
    Buffer<Bounds> blocks(memory);
    if (options.fast) blocks.allocate(blocks_for(triangles.size()));
    const Task task{references.data(), blocks.data(), nodes.data(), options, control, memory};
    Range root{};
    root.end = uint32_t(triangles.size());
    if (options.fast)
        root.extent.bounds =
            make_sorted_references(triangles, scheduler, memory, references.data(), blocks.data());
    else
        root.extent = make_references(triangles, scheduler, memory, references.data());
    root.cell = root.extent.bounds;
    tree.bounds = root.cell.box();

    base::Vector<Subtree> subtrees(memory);
    Statistics statistics;
    build_top(task, root, scheduler, tree.nodes, subtrees, statistics);
    control.throw_if_cancelled();
    build_subtrees(task, subtrees, scheduler);
    join(task, subtrees, scheduler, tree);
    write_report(subtrees, statistics, options, tree);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    tree.report.build_ms = elapsed.count();
    return tree;
}

} // namespace peregrine::accel::bih
