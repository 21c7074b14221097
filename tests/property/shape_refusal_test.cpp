// What queries of shapes refuse, before anything is written.
#include "query/shapes.h"
#include "shape_world.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace peregrine::test {
namespace {

using math::Vec3;
using scene::MeshKind;

class BadShapes : public testing::Test {
protected:
    void SetUp() override {
        world_.add(soup(1, 10, 0.5f), MeshKind::fixed);
        world_.commit();
    }

    template <class Call>
    void expect_refused(Call&& call, const std::string& words) {
        try {
            call();
            FAIL() << "not refused: " << words;
        } catch (const base::Error& error) {
            EXPECT_EQ(error.code, base::Code::invalid_argument);
            EXPECT_EQ(std::string(error.text).substr(0, words.size()), words);
        }
    }

    // The third of three records is bad; nothing is written for the first two.
    void refuse(const query::Sweep& bad, const std::string& words) {
        std::vector<query::Sweep> sweeps(3, kGood);
        sweeps[2] = bad;
        std::vector<query::SweepHit> hits(3);
        std::memset(static_cast<void*>(hits.data()), 0x5a, sizeof(query::SweepHit) * 3);
        const std::vector<query::SweepHit> before = hits;
        expect_refused([&] { query::sweep(world_.snapshot(), placed(sweeps), {}, strided(hits)); },
                       "sweep 2: " + words);
        EXPECT_EQ(std::memcmp(before.data(), hits.data(), sizeof(query::SweepHit) * 3), 0);
    }
    void refuse(const query::Shape& bad, const std::string& words) {
        std::vector<query::Shape> shapes{bad};
        std::vector<uint8_t> overlaps{9};
        expect_refused(
            [&] { query::overlap_any(world_.snapshot(), placed(shapes), {}, strided(overlaps)); },
            "shape 0: " + words);
        EXPECT_EQ(overlaps[0], 9);
    }

    static constexpr query::Sweep kGood = {Vec3(0), 1, Vec3(0), 1, Vec3(1), 0};
    ShapeWorld world_{base::Isa::best, trace::Structure::bvh};
};

constexpr float kBad[] = {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(), -1.1e30f};

TEST_F(BadShapes, Sweeps) {
    for (const float bad : kBad) {
        query::Sweep sweep = kGood;
        sweep.center.y = bad;
        refuse(sweep, "center y is ");
        sweep = kGood;
        sweep.axis.z = bad;
        refuse(sweep, "axis z is ");
        sweep = kGood;
        sweep.direction.x = bad;
        refuse(sweep, "direction x is ");
        sweep = kGood;
        sweep.radius = bad;
        refuse(sweep, "radius is ");
    }
    query::Sweep sweep = kGood;
    sweep.radius = -1e-9f;
    refuse(sweep, "radius is -1e-09; it must not be negative");
    sweep = kGood;
    sweep.direction = Vec3(0);
    refuse(sweep, "the direction is zero");
    sweep = kGood;
    sweep.t_max = kBad[0];
    refuse(sweep, "t_max is NaN");
    sweep = kGood;
    sweep.reserved = 1;
    refuse(sweep, "reserved must be 0");
}

TEST_F(BadShapes, ShapesAndPoints) {
    for (const float bad : kBad) {
        query::Shape shape{Vec3(0), 1, Vec3(0), 0, {}};
        shape.center.x = bad;
        refuse(shape, "center x is ");
        shape = {Vec3(0), bad, Vec3(0), 0, {}};
        refuse(shape, "radius is ");
        shape = {Vec3(0), 1, {0, bad, 0}, 1, {}};
        refuse(shape, "extent y is ");
        shape = {Vec3(0), 0, {0, 0, bad}, 2, {0, 0, 0, 1}};
        refuse(shape, "extent z is ");
        shape = {Vec3(0), 0, Vec3(1), 2, {0, bad, 0, 1}};
        refuse(shape, "rotation y is ");
        std::vector<query::Point> points{{{0, 0, bad}, 1}};
        std::vector<query::NearestPoint> nearest(1);
        const auto ask = [&] {
            query::nearest(world_.snapshot(), placed(points), {}, strided(nearest));
        };
        expect_refused(ask, "point 0: position z is ");
    }
    std::vector<query::Point> points{{Vec3(0), kBad[0]}};
    std::vector<query::NearestPoint> nearest(1);
    expect_refused([&] { query::nearest(world_.snapshot(), placed(points), {}, strided(nearest)); },
                   "point 0: radius is NaN");
    refuse(query::Shape{Vec3(0), 0, {1, -1, 1}, 2, {0, 0, 0, 1}},
           "extent y is -1; it must not be negative");
    refuse(query::Shape{Vec3(0), 0, Vec3(1), 2, {}}, "the rotation is zero");
    refuse(query::Shape{Vec3(0), 0, Vec3(1), 3, {}}, "kind is unknown");
}

} // namespace
} // namespace peregrine::test
