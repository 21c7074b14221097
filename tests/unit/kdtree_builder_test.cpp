#include "accel/kdtree/builder.h"

#include "builder_checks.h"
#include "geometry/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace peregrine::accel::kdtree {
namespace {

using geometry::Triangle;
using math::Box;
using math::Vec3;
using math::Vec3d;
using namespace test;

auto builder(const BuildOptions& options = {}) {
    return with_options(build, options);
}

Tree build_with(const Triangles& triangles, uint32_t workers, const BuildOptions& options = {}) {
    return build_alone(builder(options), triangles, workers);
}

class Checker {
public:
    Checker(const Tree& tree, const Triangles& triangles) : tree_(tree), triangles_(triangles) {}

    void check_structure() {
        seen_.assign(tree_.nodes.size(), 0);
        visit(0, tree_.bounds, 0);
        for (uint8_t seen : seen_) EXPECT_EQ(seen, 1);
        const BuildReport& report = tree_.report;
        EXPECT_EQ(references_, tree_.references.size());
        EXPECT_EQ(report.leaves, leaves_);
        EXPECT_EQ(report.empty_leaves, empty_leaves_);
        EXPECT_EQ(report.max_depth, max_depth_);
        EXPECT_EQ(tree_.nodes.size(), 2 * leaves_ - 1);
        EXPECT_LE(report.max_depth, report.depth_limit);
        EXPECT_LE(report.depth_limit, kMaxDepth);
        EXPECT_TRUE(std::isfinite(report.sah_cost));
    }

    // Of a point that is at least `tolerance` away from split planes the only leaf, otherwise one
    // of its leaves, must have the triangle.
    void check_coverage(double tolerance_of_coordinate) {
        expect_coverage(triangles_, tolerance_of_coordinate,
                        [&](const Vec3d& point, uint32_t triangle, double tolerance) {
                            return covered(0, point, triangle, tolerance);
                        });
    }

private:
    void visit(uint32_t index, const Box& cell, uint32_t depth) {
        ASSERT_LT(index, tree_.nodes.size());
        ++seen_[index];
        const Node& node = tree_.nodes[index];
        if (node.is_leaf()) return visit_leaf(node, cell, depth);
        ASSERT_GT(node.left_child(), index);
        const int axis = int(node.axis());
        ASSERT_GT(node.split, cell.lower[axis]);
        ASSERT_LT(node.split, cell.upper[axis]);
        Box left = cell;
        Box right = cell;
        left.upper[axis] = right.lower[axis] = node.split;
        visit(node.left_child(), left, depth + 1);
        visit(node.left_child() + 1, right, depth + 1);
    }

    void visit_leaf(const Node& node, const Box& cell, uint32_t depth) {
        ++leaves_;
        max_depth_ = std::max(max_depth_, depth);
        empty_leaves_ += node.reference_count() == 0;
        EXPECT_EQ(node.first_reference, node.reference_count() > 0 ? references_ : 0);
        references_ += node.reference_count();
        ASSERT_LE(references_, tree_.references.size());
        const uint32_t* references = tree_.references.data() + node.first_reference;
        for (uint32_t i = 0; i < node.reference_count(); ++i) {
            ASSERT_LT(references[i], triangles_.size());
            ASSERT_TRUE(i == 0 || references[i - 1] < references[i]);
            ASSERT_FALSE(geometry::clip(triangles_[references[i]], cell).empty());
        }
    }

    bool covered(uint32_t index, const Vec3d& p, uint32_t triangle, double tolerance) const {
        const Node& node = tree_.nodes[index];
        if (node.is_leaf()) {
            const auto first = tree_.references.begin() + node.first_reference;
            return std::binary_search(first, first + node.reference_count(), triangle);
        }
        const double distance = p[int(node.axis())] - double(node.split);
        return (distance <= tolerance && covered(node.left_child(), p, triangle, tolerance))
               || (distance >= -tolerance
                   && covered(node.left_child() + 1, p, triangle, tolerance));
    }

    const Tree& tree_;
    const Triangles& triangles_;
    std::vector<uint8_t> seen_;
    uint64_t leaves_ = 0;
    uint64_t empty_leaves_ = 0;
    uint64_t references_ = 0;
    uint32_t max_depth_ = 0;
};

void expect_good(const Triangles& triangles, double tolerance, const BuildOptions& options = {}) {
    const Tree tree = build_with(triangles, 1, options);
    Checker checker(tree, triangles);
    checker.check_structure();
    checker.check_coverage(tolerance);
}

void expect_same(const Tree& a, const Tree& b) {
    expect_same_bytes(a.nodes, b.nodes);
    EXPECT_EQ(a.references, b.references);
    EXPECT_EQ(a.report.sah_cost, b.report.sah_cost);
}

TEST(KdTreeBuilder, NothingGivesOneEmptyLeaf) {
    const Tree tree = build_with({}, 2);
    ASSERT_EQ(tree.nodes.size(), 1u);
    EXPECT_TRUE(tree.nodes[0].is_leaf());
    EXPECT_EQ(tree.nodes[0].reference_count(), 0u);
    EXPECT_TRUE(tree.references.empty());
    EXPECT_TRUE(tree.bounds.empty());
    EXPECT_EQ(tree.report.sah_cost, 0);
}

TEST(KdTreeBuilder, OneOrTwoTriangles) {
    const Triangle a = make({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Triangle b = make({5, 5, 5}, {6, 5, 5}, {5, 6, 5});
    expect_good({a}, 0);
    expect_good({a, b}, 0);
    EXPECT_GT(build_with({a, b}, 1).nodes.size(), 1u);
}

TEST(KdTreeBuilder, SmallTriangles) {
    expect_good(Random(1).soup(5000, 512), 0);
}
TEST(KdTreeBuilder, LargeTriangles) {
    expect_good(Random(2).soup(500, 32768), 0);
}
TEST(KdTreeBuilder, AllInOnePlane) {
    expect_good(grid(40), 0);
}
TEST(KdTreeBuilder, Needles) {
    expect_good(needles(1000), 0);
}
TEST(KdTreeBuilder, GeometricSeries) {
    expect_good(series(3000, 120), 0);
}

// Each crosses most others: the heuristic alone would go on for hundreds of references each.
TEST(KdTreeBuilder, MemoryStaysBounded) {
    const Triangles triangles = Random(14).soup(5000, 32768);
    const Tree tree = build_with(triangles, 2);
    Checker(tree, triangles).check_structure();
    EXPECT_LE(tree.references.size(), 64 * triangles.size());
    EXPECT_LE(tree.nodes.size(), 128 * triangles.size());
}

TEST(KdTreeBuilder, EmptyBonusKeepsCoverage) {
    BuildOptions options;
    options.empty_bonus = 0.5f;
    const Triangles triangles = Random(4).soup(3000, 512);
    expect_good(triangles, 0, options);
    EXPECT_NE(build_with(triangles, 1, options).nodes.size(),
              build_with(triangles, 1).nodes.size());
}

TEST(KdTreeBuilder, PlanesInPlanes) {
    expect_good(staircases(), 0);
}

TEST(KdTreeBuilder, CoincidentTrianglesBuildQuickly) {
    Triangles triangles(1000000, make({0, 0, 0}, {1, 0, 0.5f}, {0, 1, 1}));
    Tree tree = build_with(triangles, 2);
    EXPECT_EQ(tree.references.size(), triangles.size());
    triangles.assign(100000, make({4, 4, 4}, {5, 4, 4}, {4, 5, 4}));
    triangles.push_back(make({0, 0, 0}, {10, 0, 0}, {0, 10, 0}));
    triangles.push_back(make({0, 0, 9}, {10, 0, 9}, {0, 10, 9}));
    expect_good(triangles, 0);
    EXPECT_LT(build_with(triangles, 1).references.size(), 110000u);
}

TEST(KdTreeBuilder, HugeAndTinyCoordinates) {
    for (const ScaledSoup& soup : soups_of_all_scales()) {
        SCOPED_TRACE(soup.scale);
        expect_good(soup.triangles, 0x1p-45);
    }
}

// Nothing in the builder has a scale of its own.
TEST(KdTreeBuilder, PowersOfTwoChangeNoBit) {
    const Triangles triangles = Random(6).soup(2000, 1024);
    const Tree one = build_with(triangles, 1);
    for (int exponent : {-90, -40, 40, 90}) {
        const float factor = std::ldexp(1.0f, exponent);
        const Tree other = build_with(scaled(triangles, factor), 1);
        ASSERT_EQ(one.nodes.size(), other.nodes.size());
        EXPECT_EQ(one.references, other.references);
        for (size_t i = 0; i < one.nodes.size(); ++i) {
            const Node& node = one.nodes[i];
            ASSERT_EQ(node.link, other.nodes[i].link);
            ASSERT_TRUE(node.is_leaf() || node.split * factor == other.nodes[i].split);
        }
    }
}

TEST(KdTreeBuilder, FarFromTheOrigin) {
    expect_good(far_soup(), 0x1p-45);
}

TEST(KdTreeBuilder, SameTreeForAnyNumberOfWorkers) {
    const Triangles triangles = Random(9).soup(20000, 1024);
    const Tree one = build_with(triangles, 1);
    Checker(one, triangles).check_structure();
    expect_same_for_any_workers(builder(), triangles, one, expect_same);
}

TEST(KdTreeBuilder, SameTreeOnAHostsScheduler) {
    expect_same_on_a_hosts_scheduler(builder(), expect_same);
}

TEST(KdTreeBuilder, SurvivesEveryFailingAllocation) {
    expect_survives_failing_allocations(builder(), Random(12).soup(4000, 1024), 10000);
}

TEST(KdTreeBuilder, ReportsProgressAndCancels) {
    expect_progress_and_cancellation(builder(), Random(13).soup(10000, 1024));
}

TEST(KdTreeBuilder, RefusesTooManyTriangles) {
    expect_too_many_triangles_refused(builder());
}

} // namespace
} // namespace peregrine::accel::kdtree
