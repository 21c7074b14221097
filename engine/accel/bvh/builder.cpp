#include "accel/bvh/builder.h"

#include "accel/bvh/collapse.h"
#include "accel/bvh/emit.h"
#include "accel/bvh/subtree.h"
#include "accel/kdtree/buffer.h"

#include <algorithm>
#include <chrono>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kMinSubtreeSize = 1024;
constexpr uint32_t kSubtreesWanted = 64;
constexpr uint32_t kTrianglesPerTask = 16384;

struct Subtree {
    Subtree(uint32_t parent_node, const Range& all, base::Memory* memory)
        : node(parent_node), range(all), nodes(memory) {}

    uint32_t node; // among the top nodes
    Range range;
    base::Vector<BinaryNode> nodes;
};

Extent make_references(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                       base::Memory* memory, Reference* references) {
    const uint32_t tasks = uint32_t((triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask);
    base::Vector<Extent> extents(tasks, memory);
    scheduler.for_each(tasks, [&](uint32_t task) {
        const uint32_t end =
            uint32_t(std::min<size_t>(triangles.size(), size_t(task + 1) * kTrianglesPerTask));
        for (uint32_t i = task * kTrianglesPerTask; i < end; ++i) {
            Bounds bounds;
            for (const math::Vec3* v : {&triangles[i].v0, &triangles[i].v1, &triangles[i].v2})
                bounds.extend(Floats{v->x, v->y, v->z, 0});
            references[i] = Reference::make(i, bounds);
            extents[task].extend(references[i]);
        }
    });
    Extent extent;
    for (const Extent& part : extents) {
        extent.bounds.extend(part.bounds);
        extent.centers.extend(part.centers);
    }
    return extent;
}

// Level by level, until ranges are small enough to be built by one thread each.
void build_top(const Task& task, Arena& arena, const Range& root, base::Scheduler& scheduler,
               base::Vector<BinaryNode>& nodes, base::Vector<Subtree>& subtrees) {
    const uint32_t subtree_size = std::max(kMinSubtreeSize, root.size() / kSubtreesWanted);
    struct Item {
        uint32_t node;
        Range range;
        Range children[2];
    };
    base::Vector<Item> level(task.memory);
    const auto add = [&](uint32_t node, const Range& range, base::Vector<Item>& to) {
        if (range.size() > subtree_size)
            to.push_back({node, range, {}});
        else
            subtrees.emplace_back(node, range, task.memory);
    };
    nodes.emplace_back();
    add(0, root, level);
    while (!level.empty()) {
        if (task.control.report(0.1f)) return;
        scheduler.for_each(uint32_t(level.size()), [&](uint32_t i) {
            split_range(task, arena, level[i].range, level[i].children[0], level[i].children[1]);
        });
        base::Vector<Item> next(task.memory);
        for (const Item& item : level) {
            const uint32_t left = uint32_t(nodes.size());
            nodes.resize(nodes.size() + 2);
            nodes[item.node].set_bounds(item.range.extent.bounds);
            nodes[item.node].first = left;
            nodes[item.node].second = left + 1;
            add(left, item.children[0], next);
            add(left + 1, item.children[1], next);
        }
        level = std::move(next);
    }
}

void build_subtrees(const Task& task, Arena& arena, base::Vector<Subtree>& subtrees,
                    base::Scheduler& scheduler) {
    uint64_t work = 0;
    for (const Subtree& subtree : subtrees) work += subtree.range.size();
    task.control.expect(work, 0.2f);
    base::Vector<uint32_t> order(task.memory);
    for (uint32_t i = 0; i < subtrees.size(); ++i) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const uint32_t size_a = subtrees[a].range.size();
        const uint32_t size_b = subtrees[b].range.size();
        return size_a != size_b ? size_a > size_b : a < b;
    });
    scheduler.for_each(uint32_t(subtrees.size()), [&](uint32_t i) {
        if (task.control.cancelled()) return;
        Subtree& subtree = subtrees[order[i]];
        build_subtree(task, arena, subtree.range, subtree.nodes);
        task.control.finish(subtree.range.size());
    });
}

// Puts a subtree's root in the place that the top nodes have for it, the rest at the end.
void join(base::Vector<BinaryNode>& nodes, base::Vector<Subtree>& subtrees) {
    size_t total = nodes.size();
    for (const Subtree& subtree : subtrees) total += subtree.nodes.size() - 1;
    nodes.reserve(total);
    for (Subtree& subtree : subtrees) {
        const uint32_t offset = uint32_t(nodes.size()) - 1;
        for (BinaryNode& node : subtree.nodes) {
            if (node.is_leaf()) continue;
            node.first += offset;
            node.second += offset;
        }
        nodes[subtree.node] = subtree.nodes[0];
        nodes.insert(nodes.end(), subtree.nodes.begin() + 1, subtree.nodes.end());
        subtree.nodes.clear();
        subtree.nodes.shrink_to_fit();
    }
}

Effort effort_for(Quality quality) {
    switch (quality) {
    case Quality::fast:
        return {16, 0, 0, 0};
    case Quality::best:
        return {32, 32, 0.25, 1e-6f};
    default:
        return {16, 16, 0.25, 1e-5f};
    }
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
    Task task{triangles.data(), options, effort_for(options.quality), control, memory};
    Tree tree(memory);
    if (control.report(0)) control.throw_if_cancelled();
    if (triangles.empty()) return tree;

    const uint32_t count = uint32_t(triangles.size());
    Arena arena(count + uint32_t(double(count) * task.effort.duplicates), memory);
    Range root{0, count, 0, arena.capacity(), 0, {}};
    root.extent = make_references(triangles, scheduler, memory, arena.data());
    tree.bounds = root.extent.bounds.box();
    task.root_scale = scale_of(root.extent.bounds);
    task.root_area =
        half_area((root.extent.bounds.upper - root.extent.bounds.lower) * task.root_scale);

    base::Vector<BinaryNode> binary(memory);
    base::Vector<Subtree> subtrees(memory);
    build_top(task, arena, root, scheduler, binary, subtrees);
    control.throw_if_cancelled();
    build_subtrees(task, arena, subtrees, scheduler);
    control.throw_if_cancelled();
    join(binary, subtrees);
    const WideTree wide = collapse(task, binary);
    emit(task, binary, arena.data(), wide, scheduler, tree);

    tree.report.sah_cost = wide.cost;
    tree.report.max_depth = wide.depth;
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    tree.report.build_ms = elapsed.count();
    return tree;
}

} // namespace peregrine::accel::bvh
