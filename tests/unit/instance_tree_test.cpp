// The tree over instances: each in one leaf, within the boxes above it, no deeper than stacks are.
#include "accel/instances/builder.h"
#include "accel/instances/rest.h"

#include <gtest/gtest.h>

#include <random>

namespace peregrine::accel::instances {
namespace {

struct Built {
    base::Vector<Extent> extents;
    base::Vector<Place> places;
    base::Vector<Node> nodes;
    math::Box bounds;

    // Some of them in one place, some flat, some far away.
    explicit Built(uint32_t count) {
        std::mt19937 random(count);
        std::uniform_real_distribution<float> unit(-1, 1);
        const auto point = [&] { return math::Vec3(unit(random), unit(random), unit(random)); };
        for (uint32_t i = 0; i < count; ++i) {
            Extent extent;
            const math::Vec3 center = i % 3 == 0 ? math::Vec3(0) : point() * (i % 7 ? 1.0f : 1e6f);
            extent.box.extend(center);
            if (i % 5 != 0) extent.box.extend(center + 0.1f * point());
            extent.margin = std::fabs(unit(random));
            extent.slope = std::fabs(unit(random));
            extents.push_back(extent);
        }
        bounds = build(extents, places, nodes);
    }
};

bool holds(const Extent& outer, const Extent& inner) {
    const math::Box both = math::intersection(outer.box, inner.box);
    return both.lower == inner.box.lower && both.upper == inner.box.upper
           && outer.margin >= inner.margin && outer.slope >= inner.slope;
}

class Check {
public:
    explicit Check(const Built& built) : built_(built), seen_(built.extents.size()) {
        if (!built.nodes.empty()) visit(0, 1, nullptr);
    }

    void expect_sound() const {
        for (size_t i = 0; i < seen_.size(); ++i) EXPECT_EQ(seen_[i], 1u) << i;
        EXPECT_EQ(visited_, built_.nodes.size());
        EXPECT_LE(depth_, kMaxDepth);
    }

private:
    void visit(uint32_t at, uint32_t depth, const Extent* above) {
        const Node& node = built_.nodes[at];
        ++visited_;
        depth_ = std::max(depth_, depth);
        ASSERT_GE(node.count, 1u);
        ASSERT_LE(node.count, kWidth);
        for (uint32_t i = 0; i < node.count; ++i) {
            const Extent extent = node.extent(i);
            if (above) {
                EXPECT_TRUE(holds(*above, extent));
            }
            if (node.child[i].is_leaf()) {
                const uint32_t instance = node.child[i].instance();
                ASSERT_LT(instance, seen_.size());
                ++seen_[instance];
                EXPECT_TRUE(holds(extent, built_.extents[instance]));
            } else {
                visit(node.child[i].node(), depth + 1, &extent);
            }
        }
    }

    const Built& built_;
    std::vector<uint32_t> seen_;
    size_t visited_ = 0;
    uint32_t depth_ = 0;
};

TEST(InstanceTree, EachInstanceLiesInOneLeaf) {
    for (const uint32_t count : {0u, 1u, 2u, 7u, 8u, 9u, 16u, 17u, 63u, 64u, 65u, 1000u, 5000u}) {
        const Built built(count);
        SCOPED_TRACE(count);
        Check(built).expect_sound();
        EXPECT_LE(built.nodes.size(), count / 2 + 1);
        for (const Extent& extent : built.extents) EXPECT_TRUE(holds({built.bounds, 2, 2}, extent));
    }
}

// What floats leave of boxes that are far away, to 2^-46 of their distance, on the safe side.
TEST(InstanceTree, RestsBelongToBoxesInDouble) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto point = [&] { return math::Vec3d(unit(random), unit(random), unit(random)); };
    for (const double far : {0.0, 1e3, 1e7, 1e12, 1e29}) {
        base::Vector<ExactExtent> exact;
        base::Vector<Extent> rounded;
        for (int i = 0; i < 300; ++i) {
            const math::Vec3d a = point() * (i % 9 ? 100.0 : far) + far;
            const math::Vec3d b = a + glm::abs(point());
            exact.push_back({a, b, float(i)});
            Extent& extent = rounded.emplace_back();
            for (int k = 0; k < 3; ++k) {
                extent.box.lower[k] = std::nextafter(float(a[k]), -HUGE_VALF);
                extent.box.upper[k] = std::nextafter(float(b[k]), HUGE_VALF);
            }
            extent.margin = 0x1p-19f * float(far);
        }
        base::Vector<Place> places;
        base::Vector<Node> nodes;
        const math::Box bounds = build(rounded, places, nodes);
        EXPECT_EQ(are_far(rounded, bounds), far > 1e3);
        base::HostMemory memory{{}};
        base::Vector<NodeRest> rests(&memory);
        find_rests(nodes, exact, &memory, rests);
        ASSERT_EQ(rests.size(), nodes.size());
        const double error = 0x1p-46 * (2 * far + 200);
        const auto box_of = [&](uint32_t at, uint32_t i) {
            ExactExtent box{{}, {}, rests[at].margin[i]};
            for (int k = 0; k < 3; ++k) {
                box.lower[k] = double(nodes[at].lower[k][i]) + double(rests[at].lower[k][i]);
                box.upper[k] = double(nodes[at].upper[k][i]) + double(rests[at].upper[k][i]);
            }
            return box;
        };
        for (uint32_t at = 0; at < nodes.size(); ++at)
            for (uint32_t i = 0; i < nodes[at].count; ++i) {
                const ExactExtent box = box_of(at, i);
                const Link link = nodes[at].child[i];
                ExactExtent inside =
                    link.is_leaf() ? exact[link.instance()] : box_of(link.node(), 0);
                if (!link.is_leaf())
                    for (uint32_t k = 1; k < nodes[link.node()].count; ++k)
                        inside.extend(box_of(link.node(), k));
                EXPECT_EQ(box.margin, inside.margin);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_LE(box.lower[k], inside.lower[k] + (link.is_leaf() ? 0 : error));
                    EXPECT_GE(box.upper[k], inside.upper[k] - (link.is_leaf() ? 0 : error));
                    EXPECT_NEAR(box.lower[k], inside.lower[k], error);
                    EXPECT_NEAR(box.upper[k], inside.upper[k], error);
                }
            }
    }
}

} // namespace
} // namespace peregrine::accel::instances
