#include "accel/bvh/builder.h"

#include "builder_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace peregrine::accel::bvh {
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
        blocks_seen_.assign(tree_.blocks.size(), 0);
        visit(0, 1);
        for (uint8_t seen : seen_) ASSERT_EQ(seen, 1);
        for (uint8_t seen : blocks_seen_) ASSERT_EQ(seen, 1);
        const BuildReport& report = tree_.report;
        EXPECT_EQ(report.references, references_);
        EXPECT_EQ(report.leaves, leaves_);
        EXPECT_EQ(report.max_depth, max_depth_);
        EXPECT_EQ(report.largest_leaf, largest_leaf_);
        EXPECT_LE(max_depth_, kMaxDepth);
        EXPECT_TRUE(std::isfinite(report.sah_cost));
        Box all;
        for (const Triangle& t : triangles_) all.extend(geometry::bounds(t));
        EXPECT_EQ(tree_.bounds.lower, all.lower);
        EXPECT_EQ(tree_.bounds.upper, all.upper);
    }

    // Every point lies in the box of a leaf that has the triangle, and in all boxes above.
    void check_coverage(double tolerance_of_coordinate) {
        expect_coverage(triangles_, tolerance_of_coordinate,
                        [&](const Vec3d& point, uint32_t triangle, double tolerance) {
                            return covered(0, point, triangle, tolerance);
                        });
    }

private:
    void visit(uint32_t index, uint32_t depth) {
        ASSERT_LT(index, tree_.nodes.size());
        ++seen_[index];
        max_depth_ = std::max(max_depth_, depth);
        const Node& node = tree_.nodes[index];
        uint32_t children = 0;
        while (children < kWidth && node.lower[0][children] <= node.upper[0][children]) ++children;
        ASSERT_GE(children, 1u);
        check_order(node, children);
        for (uint32_t i = children; i < kWidth; ++i) {
            for (uint32_t axis = 0; axis < 3; ++axis) {
                ASSERT_EQ(node.lower[axis][i], std::numeric_limits<float>::infinity());
                ASSERT_EQ(node.upper[axis][i], -std::numeric_limits<float>::infinity());
            }
        }
        for (uint32_t i = 0; i < children; ++i) {
            if (node.child[i].is_leaf()) {
                visit_leaf(node.child[i]);
            } else {
                ASSERT_GT(node.child[i].node(), index);
                visit(node.child[i].node(), depth + 1);
            }
        }
    }

    static void check_order(const Node& node, uint32_t children) {
        for (uint32_t order : node.order) {
            uint32_t places = 0;
            for (uint32_t i = 0; i < kWidth; ++i) {
                const uint32_t place = order >> 3 * i & 7;
                places |= 1u << place;
                ASSERT_EQ(place < children, i < children);
            }
            ASSERT_EQ(places, 0xffu);
            ASSERT_EQ(order >> 24, 0u);
        }
    }

    void visit_leaf(const Link& leaf) {
        ++leaves_;
        references_ += leaf.count();
        largest_leaf_ = std::max<uint64_t>(largest_leaf_, leaf.count());
        ASSERT_GE(leaf.count(), 1u);
        ASSERT_LE(leaf.count(), kMaxLeaf);
        const uint32_t blocks = (leaf.count() + kBlockWidth - 1) / kBlockWidth;
        ASSERT_LE(leaf.first_block() + blocks, tree_.blocks.size());
        std::set<uint32_t> members;
        for (uint32_t i = 0; i < blocks * kBlockWidth; ++i) {
            if (i % kBlockWidth == 0) ++blocks_seen_[leaf.first_block() + i / kBlockWidth];
            const uint32_t triangle = at(leaf, i);
            ASSERT_LT(triangle, triangles_.size());
            if (i < leaf.count())
                ASSERT_TRUE(members.insert(triangle).second) << "twice in a leaf";
            else
                ASSERT_EQ(triangle, at(leaf, leaf.count() - 1));
            check_vertices(leaf, i, triangles_[triangle]);
        }
    }

    uint32_t at(const Link& leaf, uint32_t i) const {
        return tree_.blocks[leaf.first_block() + i / kBlockWidth].triangle[i % kBlockWidth];
    }

    void check_vertices(const Link& leaf, uint32_t i, const Triangle& t) const {
        const Block& block = tree_.blocks[leaf.first_block() + i / kBlockWidth];
        const Vec3* vertices[] = {&t.v0, &t.v1, &t.v2};
        for (int vertex = 0; vertex < 3; ++vertex)
            for (int axis = 0; axis < 3; ++axis)
                ASSERT_EQ(block.vertex[vertex][axis][i % kBlockWidth], (*vertices[vertex])[axis]);
    }

    bool covered(uint32_t index, const Vec3d& p, uint32_t triangle, double tolerance) const {
        const Node& node = tree_.nodes[index];
        for (uint32_t i = 0; i < kWidth; ++i) {
            bool inside = true;
            for (int axis = 0; axis < 3; ++axis)
                inside = inside && p[axis] >= double(node.lower[axis][i]) - tolerance
                         && p[axis] <= double(node.upper[axis][i]) + tolerance;
            if (!inside) continue;
            const Link link = node.child[i];
            if (!link.is_leaf()) {
                if (covered(link.node(), p, triangle, tolerance)) return true;
                continue;
            }
            for (uint32_t k = 0; k < link.count(); ++k)
                if (at(link, k) == triangle) return true;
        }
        return false;
    }

    const Tree& tree_;
    const Triangles& triangles_;
    std::vector<uint8_t> seen_;
    std::vector<uint8_t> blocks_seen_;
    uint64_t leaves_ = 0;
    uint64_t references_ = 0;
    uint64_t largest_leaf_ = 0;
    uint32_t max_depth_ = 0;
};

constexpr Quality kQualities[] = {Quality::fast, Quality::balanced, Quality::best};

BuildOptions with(Quality quality) {
    BuildOptions options;
    options.quality = quality;
    return options;
}

void expect_good(const Triangles& triangles, double tolerance) {
    for (Quality quality : kQualities) {
        SCOPED_TRACE(int(quality));
        const Tree tree = build_with(triangles, 1, with(quality));
        Checker checker(tree, triangles);
        checker.check_structure();
        checker.check_coverage(tolerance);
    }
}

void expect_same(const Tree& a, const Tree& b) {
    expect_same_bytes(a.nodes, b.nodes);
    expect_same_bytes(a.blocks, b.blocks);
    EXPECT_EQ(a.report.sah_cost, b.report.sah_cost);
}

TEST(BvhBuilder, NothingGivesNoNodes) {
    const Tree tree = build_with({}, 2);
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_TRUE(tree.blocks.empty());
    EXPECT_TRUE(tree.bounds.empty());
    EXPECT_EQ(tree.report.sah_cost, 0);
}

TEST(BvhBuilder, FewTriangles) {
    const Triangle a = make({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Triangle b = make({5, 5, 5}, {6, 5, 5}, {5, 6, 5});
    expect_good({a}, 0);
    expect_good({a, b}, 0);
    expect_good({a, a}, 0);
    for (uint32_t count = 3; count < 40; ++count) {
        expect_good(Random(count).soup(count, 4096), 0);
        expect_good(Triangles(count, a), 0);
    }
}

TEST(BvhBuilder, SmallTriangles) {
    expect_good(Random(1).soup(5000, 512), 0);
}
TEST(BvhBuilder, LargeTriangles) {
    expect_good(Random(2).soup(500, 32768), 0);
}
TEST(BvhBuilder, AllInOnePlane) {
    expect_good(grid(40), 0);
}
TEST(BvhBuilder, Needles) {
    expect_good(needles(1000), 0);
}
TEST(BvhBuilder, GeometricSeries) {
    expect_good(series(3000, 120), 0);
}

// Each crosses most others: the heuristic alone would split without end.
TEST(BvhBuilder, MemoryStaysBounded) {
    const Triangles triangles = Random(14).soup(5000, 32768);
    for (Quality quality : kQualities) {
        const Tree tree = build_with(triangles, 2, with(quality));
        Checker(tree, triangles).check_structure();
        EXPECT_LE(tree.report.references, 2 * triangles.size());
    }
}

TEST(BvhBuilder, PlanesInPlanes) {
    expect_good(staircases(), 0);
}

TEST(BvhBuilder, CoincidentTrianglesBuildQuickly) {
    Triangles triangles(1000000, make({0, 0, 0}, {1, 0, 0.5f}, {0, 1, 1}));
    for (Quality quality : {Quality::fast, Quality::balanced})
        EXPECT_EQ(build_with(triangles, 2, with(quality)).report.references, triangles.size());
    triangles.assign(2000, make({4, 4, 4}, {5, 4, 4}, {4, 5, 4}));
    triangles.push_back(make({0, 0, 0}, {10, 0, 0}, {0, 10, 0}));
    triangles.push_back(make({0, 0, 9}, {10, 0, 9}, {0, 10, 9}));
    expect_good(triangles, 0);
    EXPECT_LT(build_with(triangles, 1).report.references, 2200u);
}

TEST(BvhBuilder, HugeAndTinyCoordinates) {
    for (const ScaledSoup& soup : soups_of_all_scales()) {
        SCOPED_TRACE(soup.scale);
        expect_good(soup.triangles, 0x1p-45);
    }
}

TEST(BvhBuilder, PowersOfTwoChangeNoBit) {
    const Triangles triangles = Random(6).soup(2000, 1024);
    for (Quality quality : kQualities) {
        const Tree one = build_with(triangles, 1, with(quality));
        for (int exponent : {-60, -20, 20, 60}) {
            const float factor = std::ldexp(1.0f, exponent);
            const Tree other = build_with(scaled(triangles, factor), 1, with(quality));
            ASSERT_EQ(one.nodes.size(), other.nodes.size());
            ASSERT_EQ(one.blocks.size(), other.blocks.size());
            for (size_t i = 0; i < one.blocks.size(); ++i)
                for (uint32_t k = 0; k < kBlockWidth; ++k)
                    ASSERT_EQ(one.blocks[i].triangle[k], other.blocks[i].triangle[k]);
        }
    }
}

TEST(BvhBuilder, FarFromTheOrigin) {
    expect_good(far_soup(), 0x1p-45);
}

TEST(BvhBuilder, SameTreeForAnyNumberOfWorkers) {
    const Triangles triangles = Random(9).soup(20000, 1024);
    for (Quality quality : kQualities) {
        const Tree one = build_with(triangles, 1, with(quality));
        Checker(one, triangles).check_structure();
        expect_same_for_any_workers(builder(with(quality)), triangles, one, expect_same);
    }
}

TEST(BvhBuilder, SameTreeOnAHostsScheduler) {
    expect_same_on_a_hosts_scheduler(builder(), expect_same);
}

TEST(BvhBuilder, SurvivesEveryFailingAllocation) {
    const Triangles triangles = Random(12).soup(4000, 1024);
    for (Quality quality : kQualities)
        expect_survives_failing_allocations(builder(with(quality)), triangles, 10000);
}

TEST(BvhBuilder, ReportsProgressAndCancels) {
    const Triangles triangles = Random(13).soup(10000, 1024);
    for (Quality quality : kQualities)
        expect_progress_and_cancellation(builder(with(quality)), triangles);
}

TEST(BvhBuilder, RefusesTooManyTriangles) {
    expect_too_many_triangles_refused(builder());
}

} // namespace
} // namespace peregrine::accel::bvh
