#include "accel/bvh/builder.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace peregrine::accel::bvh {
namespace {

using geometry::Triangle;
using math::Box;
using math::Vec3;
using math::Vec3d;
using Triangles = std::vector<Triangle>;

Triangle make(const Vec3& a, const Vec3& b, const Vec3& c) {
    Triangle triangle{};
    triangle.v0 = a;
    triangle.v1 = b;
    triangle.v2 = c;
    return triangle;
}

Tree build_with(const Triangles& triangles, uint32_t workers, const BuildOptions& options = {}) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(workers, {}, memory);
    return build(triangles, options, scheduler, {}, memory);
}

// Coordinates of few bits, so that points with weights i / 64 are exact in double.
class Random {
public:
    explicit Random(uint32_t seed) : random_(seed) {}

    uint32_t below(uint32_t n) { return uint32_t(random_()) % n; }
    float coordinate(uint32_t range) { return float(below(range)) / 1024.0f; }
    Vec3 point(uint32_t range) { return {coordinate(range), coordinate(range), coordinate(range)}; }

    Triangles soup(uint32_t count, uint32_t size) {
        Triangles triangles;
        while (triangles.size() < count) {
            const Vec3 at = point(32768);
            const Triangle t = make(at + point(size), at + point(size), at + point(size));
            if (glm::cross(t.v1 - t.v0, t.v2 - t.v0) != Vec3(0)) triangles.push_back(t);
        }
        return triangles;
    }

    Vec3d inside(const Triangle& t) {
        uint32_t u = below(65);
        uint32_t v = below(65);
        if (u + v > 64) u = 64 - u, v = 64 - v;
        return (Vec3d(t.v0) * double(64 - u - v) + Vec3d(t.v1) * double(u)
                + Vec3d(t.v2) * double(v))
               / 64.0;
    }

private:
    std::mt19937 random_;
};

Triangles scaled(Triangles triangles, float factor) {
    for (Triangle& t : triangles) t.v0 *= factor, t.v1 *= factor, t.v2 *= factor;
    return triangles;
}

Triangles grid(uint32_t side) {
    Triangles triangles;
    for (uint32_t i = 0; i < side * side; ++i) {
        const Vec3 at(float(i % side), 0, float(i / side));
        triangles.push_back(make(at, at + Vec3(1, 0, 0), at + Vec3(0, 0, 1)));
        triangles.push_back(make(at + Vec3(1, 0, 0), at + Vec3(1, 0, 1), at + Vec3(0, 0, 1)));
    }
    return triangles;
}

Triangles needles(uint32_t count) {
    Random random(3);
    Triangles triangles;
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 at = random.point(1024);
        triangles.push_back(
            make(at, at + random.point(65536), at + Vec3(1.0f / 1024, 2.0f / 1024, 0)));
    }
    return triangles;
}

// |  | |||  each triangle half as large and half as far as the one before, on all axes
Triangles series(uint32_t count) {
    Triangles triangles;
    for (uint32_t i = 0; i < count; ++i) {
        const float s = std::ldexp(1.0f, 60 - int(i % 120));
        triangles.push_back(make({s, 0, 0}, {s, s, 0}, {s * 1.5f, 0, s}));
    }
    return triangles;
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
    void check_coverage(uint32_t points, double tolerance_of_coordinate) {
        Random random(11);
        const uint32_t step = uint32_t(triangles_.size()) / 4000 + 1;
        for (uint32_t i = 0; i < triangles_.size(); i += step) {
            const Triangle& t = triangles_[i];
            const Vec3 largest = glm::max(glm::max(glm::abs(t.v0), glm::abs(t.v1)), glm::abs(t.v2));
            const double tolerance =
                tolerance_of_coordinate * double(std::max({largest.x, largest.y, largest.z}));
            for (uint32_t k = 0; k < points; ++k)
                ASSERT_TRUE(covered(0, random.inside(t), i, tolerance)) << "triangle " << i;
        }
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
        checker.check_coverage(16, tolerance);
    }
}

void expect_same(const Tree& a, const Tree& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(Node)), 0);
    ASSERT_EQ(a.blocks.size(), b.blocks.size());
    EXPECT_EQ(std::memcmp(a.blocks.data(), b.blocks.data(), a.blocks.size() * sizeof(Block)), 0);
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
    expect_good(series(3000), 0);
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

// Staircases of axis-aligned triangles: planes that coincide with others and with cells' borders.
TEST(BvhBuilder, PlanesInPlanes) {
    Triangles triangles;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (Triangle t : grid(16)) {
            const auto turn = [&](Vec3 v) {
                for (uint32_t i = 0; i < axis; ++i) v = {v.z, v.x, v.y};
                return v;
            };
            for (uint32_t layer = 0; layer < 4; ++layer) {
                const Vec3 offset = turn({0, float(4 * layer), 0});
                triangles.push_back(
                    make(turn(t.v0) + offset, turn(t.v1) + offset, turn(t.v2) + offset));
            }
        }
    }
    expect_good(triangles, 0);
}

TEST(BvhBuilder, CoincidentTrianglesBuildQuickly) {
    Triangles triangles(1000000, make({0, 0, 0}, {1, 0, 0.5f}, {0, 1, 1}));
    EXPECT_EQ(build_with(triangles, 2).report.references, triangles.size());
    triangles.assign(2000, make({4, 4, 4}, {5, 4, 4}, {4, 5, 4}));
    triangles.push_back(make({0, 0, 0}, {10, 0, 0}, {0, 10, 0}));
    triangles.push_back(make({0, 0, 9}, {10, 0, 9}, {0, 10, 9}));
    expect_good(triangles, 0);
    EXPECT_LT(build_with(triangles, 1).report.references, 2200u);
}

TEST(BvhBuilder, HugeAndTinyCoordinates) {
    Random random(5);
    for (float scale : {1e-44f, 1e-38f, 1e-30f, 1e-10f, 1e10f, 1e28f}) {
        SCOPED_TRACE(scale);
        Triangles triangles;
        for (const Triangle& t : scaled(random.soup(2000, 1024), scale))
            if (t.v0 != t.v1 && t.v1 != t.v2 && t.v2 != t.v0) triangles.push_back(t);
        expect_good(triangles, 0x1p-45);
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
    Triangles triangles;
    for (Triangle t : Random(8).soup(3000, 1024)) {
        const Vec3 far(1e6f, -3e6f, 1e5f);
        t = make(t.v0 + far, t.v1 + far, t.v2 + far);
        if (glm::cross(t.v1 - t.v0, t.v2 - t.v0) != Vec3(0)) triangles.push_back(t);
    }
    expect_good(triangles, 0x1p-45);
}

TEST(BvhBuilder, SameTreeForAnyNumberOfWorkers) {
    const Triangles triangles = Random(9).soup(20000, 1024);
    for (Quality quality : kQualities) {
        const Tree one = build_with(triangles, 1, with(quality));
        Checker(one, triangles).check_structure();
        for (uint32_t workers : {2u, 5u})
            expect_same(one, build_with(triangles, workers, with(quality)));
    }
}

// A host may run all tasks on the calling thread, in any order.
TEST(BvhBuilder, SameTreeOnAHostsScheduler) {
    const Triangles triangles = Random(10).soup(10000, 1024);
    base::HostScheduler host;
    host.concurrency = 7;
    host.run = [](void*, uint32_t count, base::TaskFunction task, void* data) {
        for (uint32_t i = count; i-- > 0;) task(data, i);
    };
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(1, host, memory);
    expect_same(build_with(triangles, 1), build(triangles, {}, scheduler, {}, memory));
}

class FailingMemory final : public std::pmr::memory_resource {
public:
    explicit FailingMemory(int64_t allocations) : left_(allocations) {}
    int64_t live_bytes() const { return live_; }

private:
    void* do_allocate(size_t size, size_t alignment) override {
        if (left_.fetch_sub(1) <= 0) throw std::bad_alloc();
        live_ += int64_t(size);
        return ::operator new(size, std::align_val_t(alignment));
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override {
        live_ -= int64_t(size);
        ::operator delete(memory, std::align_val_t(alignment));
    }
    bool do_is_equal(const memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::atomic<int64_t> left_;
    std::atomic<int64_t> live_{0};
};

TEST(BvhBuilder, SurvivesEveryFailingAllocation) {
    const Triangles triangles = Random(12).soup(4000, 1024);
    base::Scheduler scheduler(2, {}, std::pmr::new_delete_resource());
    for (Quality quality : kQualities) {
        for (int64_t allowed = 0;; ++allowed) {
            FailingMemory memory(allowed);
            bool built = false;
            try {
                built = !build(triangles, with(quality), scheduler, {}, &memory).nodes.empty();
            } catch (const std::bad_alloc&) {
            }
            ASSERT_EQ(memory.live_bytes(), 0);
            if (built) break;
            ASSERT_LT(allowed, 10000);
        }
    }
}

struct Watcher {
    std::thread::id caller = std::this_thread::get_id();
    uint32_t calls = 0;
    uint32_t stop_at = ~0u;
    float last = 0;
    bool good = true;

    base::Progress progress() {
        return {[](void* user, float fraction) {
                    Watcher& self = *static_cast<Watcher*>(user);
                    self.good &= std::this_thread::get_id() == self.caller && fraction >= self.last
                                 && fraction <= 1;
                    self.last = fraction;
                    return int32_t(++self.calls >= self.stop_at);
                },
                this};
    }
};

TEST(BvhBuilder, ReportsProgressAndCancels) {
    const Triangles triangles = Random(13).soup(10000, 1024);
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(2, {}, memory);
    Watcher watcher;
    build(triangles, {}, scheduler, watcher.progress(), memory);
    EXPECT_TRUE(watcher.good);
    EXPECT_GT(watcher.calls, 4u);
    for (uint32_t stop_at = 1; stop_at <= 4; ++stop_at) {
        Watcher stopper;
        stopper.stop_at = stop_at;
        try {
            build(triangles, {}, scheduler, stopper.progress(), memory);
            FAIL() << "was not cancelled at call " << stop_at;
        } catch (const base::Error& error) {
            EXPECT_EQ(error.code, base::Code::cancelled);
        }
    }
}

TEST(BvhBuilder, RefusesTooManyTriangles) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(1, {}, memory);
    const Triangle one = make({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const std::span<const Triangle> many(&one, (size_t(1) << 27) + 1); // never read
    try {
        build(many, {}, scheduler, {}, memory);
        FAIL();
    } catch (const base::Error& error) {
        EXPECT_EQ(error.code, base::Code::limit);
    }
}

} // namespace
} // namespace peregrine::accel::bvh
