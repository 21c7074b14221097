#include "accel/bvh/builder.h"
#include "accel/bvh/compact.h"
#include "accel/bvh/quantise.h"
#include "builder_checks.h"
#include "trace/bvh/tree/decode.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace peregrine::accel::bvh {
namespace {

using geometry::Triangle;
using math::Vec3;
using namespace test;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// ------------------------------------------------------------------------------- quantisation
//
//      origin        +1        +2             +255     |: planes that bytes can say
//        |-----|-------|----[------]-|---- ... --|     [ ]: a box
//                      `-------------'                 what is decoded: the planes around it

// What bytes say contains the box, and no plane further in would do.
void expect_tight(const CompactNode& node, uint32_t axis, uint32_t place, float lower,
                  float upper) {
    const uint8_t low = node.lower[axis][place], high = node.upper[axis][place];
    EXPECT_LE(node.plane(axis, low), lower);
    EXPECT_GE(node.plane(axis, high), upper);
    EXPECT_TRUE(low == 255 || node.plane(axis, uint8_t(low + 1)) > lower);
    EXPECT_TRUE(high == 0 || node.plane(axis, uint8_t(high - 1)) < upper);
}

// As if each box were eight on all axes.
void expect_contained(const std::vector<std::pair<float, float>>& boxes) {
    Node node{};
    const auto count = uint32_t(boxes.size());
    float first = kInfinity, last = -kInfinity;
    for (uint32_t i = 0; i < count; ++i) {
        for (uint32_t axis = 0; axis < 3; ++axis) {
            node.lower[axis][i] = boxes[i].first;
            node.upper[axis][i] = boxes[i].second;
        }
        first = std::min(first, boxes[i].first);
        last = std::max(last, boxes[i].second);
    }
    CompactNode out{};
    quantise(node, count, out);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(out.origin[axis], first);
        ASSERT_GE(out.scale[axis], std::numeric_limits<float>::min());
        ASSERT_EQ(std::bit_cast<uint32_t>(out.scale[axis]) & 255, 0u);
        for (uint32_t plane = 0; plane < 256; ++plane) // exact: no rounding but the sum's
            ASSERT_EQ(double(float(plane) * out.scale[axis]),
                      double(plane) * double(out.scale[axis]));
        ASSERT_TRUE(std::isfinite(out.plane(axis, 255)));
        // Much smaller would not do, unless rounding asked for it.
        EXPECT_TRUE(out.scale[axis] == std::numeric_limits<float>::min()
                    || 0.499 * 255 * double(out.scale[axis]) <= double(last) - double(first));
        for (uint32_t i = 0; i < count; ++i)
            expect_tight(out, axis, i, boxes[i].first, boxes[i].second);
    }
}

TEST(Quantise, ContainsBoxesOfAllSizes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1, 1), exponent(-149, 99);
    const auto number = [&] { return std::ldexp(unit(random), int(exponent(random))); };
    for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
        // Around one place, which may be far from 0 for its size, or anywhere.
        const float middle = i % 3 == 0 ? 0 : number(), size = number();
        std::vector<std::pair<float, float>> boxes(1 + random() % kWidth);
        for (auto& [lower, upper] : boxes) {
            const float a = i % 4 == 0 ? number() : middle + size * unit(random);
            const float b = i % 5 == 0 ? a : i % 4 == 0 ? number() : middle + size * unit(random);
            lower = std::min(a, b);
            upper = std::max(a, b);
        }
        expect_contained(boxes);
    }
}

TEST(Quantise, ContainsBoxesAtTheEndsOfFloat) {
    const float denormal = std::numeric_limits<float>::denorm_min();
    const float normal = std::numeric_limits<float>::min();
    const float one_up = std::nextafter(1.0f, 2.0f);
    expect_contained({{0, 0}});
    expect_contained({{-0.0f, 0.0f}, {0.0f, 0.0f}});
    expect_contained({{denormal, denormal}});
    expect_contained({{-denormal, denormal}, {0, denormal}});
    expect_contained({{0, normal}, {denormal, normal}, {normal, normal}});
    expect_contained({{-1e30f, 1e30f}, {-1e30f, -1e30f}, {0, denormal}, {1e30f, 1e30f}});
    expect_contained({{1e30f, 1e30f}, {std::nextafter(1e30f, 0.0f), 1e30f}});
    expect_contained({{1, 1}, {1, one_up}, {one_up, one_up}});
    expect_contained({{-one_up, -1}, {-one_up, -one_up}});
    expect_contained({{1, one_up}, {-1e30f, 1}});
    expect_contained({{0, 255}, {1, 254}, {127, 128}, {254.5f, 255}});
    expect_contained({{0, std::nextafter(255.0f, 256.0f)}, {1, 2}});
}

TEST(Quantise, KeepsFlatBoxesFlatWhereItCan) {
    Node node{};
    for (uint32_t axis = 0; axis < 3; ++axis)
        for (uint32_t i = 0; i < kWidth; ++i) node.lower[axis][i] = node.upper[axis][i] = 7.25f;
    CompactNode out{};
    quantise(node, kWidth, out);
    for (uint32_t i = 0; i < kWidth; ++i) {
        EXPECT_EQ(out.plane(1, out.lower[1][i]), 7.25f);
        EXPECT_EQ(out.plane(1, out.upper[1][i]), 7.25f);
    }
}

// --------------------------------------------------------------------------------------- trees

// The full tree and the compact one, side by side.
class Twins {
public:
    Twins(const Tree& full, const CompactTree& compact) : full_(full), compact_(compact) {}

    void check() {
        ASSERT_EQ(full_.nodes.size(), compact_.nodes.size());
        for (size_t i = 0; i < full_.nodes.size(); ++i) compare(full_.nodes[i], compact_.nodes[i]);
        EXPECT_EQ(references_, full_.report.references);
    }

private:
    void compare(const Node& node, const CompactNode& twin) {
        Node decoded{};
        trace::bvh::decode(twin, decoded);
        for (uint32_t i = 0; i < kWidth; ++i) {
            const bool there = node.lower[0][i] <= node.upper[0][i];
            ASSERT_EQ(twin.there >> i & 1, uint32_t(there));
            if (!there) {
                ASSERT_EQ(decoded.lower[0][i], kInfinity);
                ASSERT_EQ(decoded.upper[0][i], -kInfinity);
                continue;
            }
            for (uint32_t axis = 0; axis < 3; ++axis) {
                ASSERT_LE(decoded.lower[axis][i], node.lower[axis][i]);
                ASSERT_GE(decoded.upper[axis][i], node.upper[axis][i]);
            }
            if (node.child[i].is_leaf())
                compare(node.child[i], decoded.child[i]);
            else
                ASSERT_EQ(decoded.child[i].bits, node.child[i].bits);
        }
        for (uint32_t octant = 0; octant < 4; ++octant) {
            ASSERT_EQ(decoded.order[octant], node.order[octant]);
            compare_orders(reversed_order(node.order[octant]), node.order[7 - octant], twin.there);
        }
    }

    // As far as there are children.
    static void compare_orders(uint32_t a, uint32_t b, uint32_t there) {
        for (uint32_t i = 0, k = 0; i < kWidth; ++i) {
            const uint32_t place = a >> 3 * i & 7;
            if (!(there >> place & 1)) continue;
            ASSERT_EQ(place, b >> 3 * k++ & 7);
        }
    }

    void compare(Link full, Link compact) {
        ASSERT_TRUE(compact.is_leaf());
        const LeafRecord& record = record_at(compact_.leaves.data(), compact);
        ASSERT_EQ(record.count(), full.count());
        references_ += record.count();
        const auto* end = reinterpret_cast<const std::byte*>(&compact_.leaves.back() + 1);
        ASSERT_LE(reinterpret_cast<const std::byte*>(record.group() + record.groups()), end);
        ASSERT_GE(static_cast<const void*>(record.pool()),
                  static_cast<const void*>(compact_.leaves.data()));
        for (uint32_t i = 0; i < record.groups(); ++i) {
            Block block;
            trace::bvh::decode(record.group()[i], record.pool(), block);
            ASSERT_EQ(std::memcmp(&block, &full_.blocks[full.first_block() + i], sizeof block), 0);
        }
    }

    const Tree& full_;
    const CompactTree& compact_;
    uint64_t references_ = 0;
};

CompactTree build_compact(std::span<const Triangle> triangles, base::Scheduler& scheduler,
                          const base::Progress& progress, base::Memory* memory) {
    return compact(build(triangles, {}, scheduler, progress, memory), scheduler, memory);
}

void expect_same(const CompactTree& a, const CompactTree& b) {
    expect_same_bytes(a.nodes, b.nodes);
    expect_same_bytes(a.leaves, b.leaves);
}

void expect_twins(const Triangles& triangles) {
    base::Scheduler scheduler(1, {}, std::pmr::new_delete_resource());
    for (const Quality quality : {Quality::fast, Quality::balanced, Quality::best}) {
        const Tree full =
            build(triangles, {.quality = quality}, scheduler, {}, std::pmr::new_delete_resource());
        Twins(full, compact(full, scheduler, std::pmr::new_delete_resource())).check();
    }
}

TEST(CompactBvh, OfNothingIsEmpty) {
    base::Scheduler scheduler(1, {}, std::pmr::new_delete_resource());
    const CompactTree tree = build_compact({}, scheduler, {}, std::pmr::new_delete_resource());
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_TRUE(tree.leaves.empty());
}

TEST(CompactBvh, HoldsWhatTheFullOneDoes) {
    for (uint32_t count = 1; count < 40; ++count) expect_twins(Random(count).soup(count, 1024));
    expect_twins(Random(1).soup(5000, 1024));
    expect_twins(grid(40));
    expect_twins(needles(300));
    expect_twins(series(300, 40));
    expect_twins(staircases());
    expect_twins(far_soup());
    for (const ScaledSoup& soup : soups_of_all_scales()) {
        SCOPED_TRACE(soup.scale);
        expect_twins(soup.triangles);
    }
}

// More vertices than one pool has room for: leaves of 32 triangles that share none.
TEST(CompactBvh, LargeLeavesOfOneNode) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto point = [&](uint32_t leaf) {
        return Vec3(unit(random) + 2 * float(leaf & 1), unit(random) + float(leaf & 2),
                    unit(random) + 0.5f * float(leaf & 4));
    };
    base::Memory* memory = std::pmr::new_delete_resource();
    Tree full(memory);
    full.nodes.resize(1);
    constexpr uint32_t kBlocks = kMaxLeaf / kBlockWidth;
    full.blocks.resize(kWidth * kBlocks);
    for (uint32_t leaf = 0; leaf < kWidth; ++leaf) {
        full.nodes[0].child[leaf] = Link::leaf(leaf * kBlocks, kMaxLeaf);
        for (uint32_t axis = 0; axis < 3; ++axis) {
            full.nodes[0].lower[axis][leaf] = kInfinity;
            full.nodes[0].upper[axis][leaf] = -kInfinity;
        }
        for (uint32_t i = 0; i < kMaxLeaf; ++i)
            for (uint32_t corner = 0; corner < 3; ++corner) {
                Block& block = full.blocks[leaf * kBlocks + i / kBlockWidth];
                block.triangle[i % kBlockWidth] = leaf * kMaxLeaf + i;
                const Vec3 vertex = point(leaf);
                for (int axis = 0; axis < 3; ++axis) {
                    block.vertex[corner][axis][i % kBlockWidth] = vertex[axis];
                    float& lower = full.nodes[0].lower[axis][leaf];
                    float& upper = full.nodes[0].upper[axis][leaf];
                    lower = std::min(lower, vertex[axis]);
                    upper = std::max(upper, vertex[axis]);
                }
            }
    }
    full.report.references = kWidth * kMaxLeaf;
    base::Scheduler scheduler(1, {}, memory);
    Twins(full, compact(full, scheduler, memory)).check();
}

// A closed mesh has half as many vertices as triangles: most are in one pool or two.
TEST(CompactBvh, SharesVertices) {
    base::Memory* memory = std::pmr::new_delete_resource();
    base::Scheduler scheduler(1, {}, memory);
    const Triangles triangles = grid(100);
    const CompactTree tree = build_compact(triangles, scheduler, {}, memory);
    const size_t bytes =
        tree.nodes.size() * sizeof(CompactNode) + tree.leaves.size() * sizeof(LeafUnit);
    EXPECT_LT(double(bytes) / double(triangles.size()), 25);
}

TEST(CompactBvh, SameForAnyNumberOfWorkers) {
    const Triangles triangles = Random(9).soup(20000, 1024);
    const CompactTree one = build_alone(build_compact, triangles, 1);
    expect_same_for_any_workers(build_compact, triangles, one, expect_same);
    expect_same_on_a_hosts_scheduler(build_compact, expect_same);
}

TEST(CompactBvh, SurvivesEveryFailingAllocation) {
    expect_survives_failing_allocations(build_compact, Random(12).soup(4000, 1024), 10000);
}

} // namespace
} // namespace peregrine::accel::bvh
