#include "accel/bih/builder.h"

#include "builder_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace peregrine::accel::bih {
namespace {

using geometry::Triangle;
using math::Box;
using math::Vec3;
using namespace test;

auto builder(bool fast = false) {
    BuildOptions options;
    options.fast = fast;
    return with_options(build, options);
}

Tree build_with(const Triangles& triangles, uint32_t workers, bool fast = false) {
    return build_alone(builder(fast), triangles, workers);
}

Triangles soup(uint32_t seed, size_t count, float size, float scale = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto point = [&] { return Vec3(unit(random), unit(random), unit(random)); };
    Triangles triangles;
    while (triangles.size() < count) {
        const Vec3 at = point();
        triangles.push_back(make(scale * (at + size * point()), scale * (at + size * point()),
                                 scale * (at + size * point())));
    }
    return triangles;
}

// Every triangle in one leaf, whole within each plane on the way there.
class Checker {
public:
    Checker(const Tree& tree, const Triangles& triangles)
        : tree_(tree), triangles_(triangles), seen_(tree.nodes.size()),
          referenced_(triangles.size()) {}

    void check() {
        visit(0, tree_.bounds, 0);
        for (uint8_t seen : seen_) ASSERT_EQ(seen, 1);
        for (uint8_t referenced : referenced_) ASSERT_EQ(referenced, 1);
        const BuildReport& report = tree_.report;
        EXPECT_EQ(tree_.references.size(), triangles_.size());
        EXPECT_EQ(report.leaves, leaves_);
        EXPECT_EQ(report.largest_leaf, largest_leaf_);
        EXPECT_EQ(report.max_depth, max_depth_);
        EXPECT_LE(report.max_depth, kMaxDepth);
        EXPECT_LE(report.largest_leaf, 8u);
        EXPECT_TRUE(std::isfinite(report.sah_cost));
    }

private:
    void visit(uint32_t index, const Box& cell, uint32_t depth) {
        ASSERT_LT(index, tree_.nodes.size());
        ASSERT_EQ(seen_[index]++, 0);
        const Node& node = tree_.nodes[index];
        if (node.is_leaf()) return visit_leaf(node, cell, depth);
        ASSERT_GT(node.child(), index);
        const int axis = int(node.axis());
        ASSERT_LT(axis, 3);
        for (float clip : node.clip) {
            ASSERT_GE(clip, cell.lower[axis]);
            ASSERT_LE(clip, cell.upper[axis]);
        }
        Box first = cell, second = cell;
        if (node.is_cut()) {
            first.lower[axis] = node.clip[0];
            first.upper[axis] = node.clip[1];
            return visit(node.child(), first, depth);
        }
        first.upper[axis] = node.clip[0];
        second.lower[axis] = node.clip[1];
        visit(node.child(), first, depth + 1);
        visit(node.child() + 1, second, depth + 1);
    }

    void visit_leaf(const Node& node, const Box& cell, uint32_t depth) {
        ++leaves_;
        max_depth_ = std::max(max_depth_, depth);
        largest_leaf_ = std::max<uint64_t>(largest_leaf_, node.reference_count());
        ASSERT_GT(node.reference_count(), 0u);
        ASSERT_LE(node.first_reference() + node.reference_count(), tree_.references.size());
        for (uint32_t i = 0; i < node.reference_count(); ++i) {
            const uint32_t triangle = tree_.references[node.first_reference() + i];
            ASSERT_LT(triangle, triangles_.size());
            ++referenced_[triangle];
            const Box box = geometry::bounds(triangles_[triangle]);
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(box.lower, cell.lower)));
            ASSERT_TRUE(glm::all(glm::lessThanEqual(box.upper, cell.upper)));
        }
    }

    const Tree& tree_;
    const Triangles& triangles_;
    std::vector<uint8_t> seen_, referenced_;
    uint64_t leaves_ = 0, largest_leaf_ = 0;
    uint32_t max_depth_ = 0;
};

void expect_good(const Triangles& triangles) {
    for (const bool fast : {false, true}) {
        const Tree tree = build_with(triangles, 2, fast);
        Checker(tree, triangles).check();
    }
}

void expect_same(const Tree& a, const Tree& b) {
    expect_same_bytes(a.nodes, b.nodes);
    EXPECT_EQ(a.references, b.references);
    EXPECT_EQ(a.report.sah_cost, b.report.sah_cost);
}

TEST(BihBuilder, NothingGivesNothing) {
    const Tree tree = build_with({}, 2);
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_TRUE(tree.references.empty());
    EXPECT_TRUE(tree.bounds.empty());
}

TEST(BihBuilder, OneOrTwoTriangles) {
    const Triangle a = make({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Triangle b = make({5, 5, 5}, {6, 5, 5}, {5, 6, 5});
    expect_good({a});
    expect_good({a, b});
    expect_good({a, a});
    EXPECT_EQ(build_with({a, b}, 1).report.leaves, 2u);
}

TEST(BihBuilder, SmallAndLargeTriangles) {
    expect_good(soup(1, 20000, 0.02f));
    expect_good(soup(2, 3000, 1));
}

TEST(BihBuilder, HugeAndTinyCoordinates) {
    for (float scale : {1e-44f, 1e-38f, 1e-30f, 1e-10f, 1e10f, 4e29f}) {
        SCOPED_TRACE(scale);
        expect_good(soup(3, 3000, 0.1f, scale));
    }
}

// No plane separates them: halved until leaves are small.
TEST(BihBuilder, CoincidentTriangles) {
    Triangles triangles(100000, make({0, 0, 0}, {1, 0, 0.5f}, {0, 1, 1}));
    expect_good(triangles);
    triangles.push_back(make({9, 9, 9}, {10, 9, 9}, {9, 10, 9}));
    expect_good(triangles);
}

// One plane at a time would split off one of them.
TEST(BihBuilder, GeometricSeriesStaysWithinTheDepth) {
    expect_good(series(3000, 180));
}

// Two crowds far apart in a diagonal: their cells are empty but for a corner.
TEST(BihBuilder, CutsOffEmptySpace) {
    Triangles triangles = soup(4, 2000, 0.05f);
    for (Triangle& t : triangles) {
        const Vec3 move(t.v0.x < 0 ? -20.0f : 20.0f);
        t = make(t.v0 + move, t.v1 + move, t.v2 + move);
    }
    const Tree tree = build_with(triangles, 1);
    Checker(tree, triangles).check();
    uint32_t cuts = 0;
    for (const Node& node : tree.nodes) cuts += !node.is_leaf() && node.is_cut();
    EXPECT_GT(cuts, 2u);
}

TEST(BihBuilder, SameTreeForAnyNumberOfWorkers) {
    const Triangles triangles = soup(5, 50000, 0.02f);
    for (const bool fast : {false, true}) {
        const Tree one = build_with(triangles, 1, fast);
        Checker(one, triangles).check();
        expect_same_for_any_workers(builder(fast), triangles, one, expect_same);
    }
}

// Not so good a tree, but of the same kind.
TEST(BihBuilder, FastCostsLittleMoreToTrace) {
    const Triangles triangles = soup(8, 20000, 0.02f);
    const double best = build_with(triangles, 1).report.sah_cost;
    EXPECT_LT(build_with(triangles, 1, true).report.sah_cost, 1.5 * best);
}

TEST(BihBuilder, SurvivesEveryFailingAllocation) {
    for (const bool fast : {false, true})
        expect_survives_failing_allocations(builder(fast), soup(6, 5000, 0.05f), 1000);
}

TEST(BihBuilder, ReportsProgressAndCancels) {
    for (const bool fast : {false, true})
        expect_progress_and_cancellation(builder(fast), soup(7, 50000, 0.02f));
}

TEST(BihBuilder, RefusesTooManyTriangles) {
    expect_too_many_triangles_refused(builder());
}

} // namespace
} // namespace peregrine::accel::bih
