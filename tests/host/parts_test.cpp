#include <gtest/gtest.h>

#include "cameras.h"
#include "error.h"
#include "flight.h"
#include "frame_log.h"
#include "image_file.h"

// The small parts that need no engine: camera choice, flights, numbered names, medians.
namespace host::test {
namespace {

Viewpoint stop(const char* name, double x, glm::vec3 forward) {
    Viewpoint view;
    view.name = name;
    view.position = {x, 0, 0};
    view.forward = forward;
    return view;
}

TEST(Cameras, AreFoundByNameOrIndex) {
    const std::vector<Viewpoint> cameras = {stop("a", 0, {0, 0, -1}), stop("b", 1, {0, 0, -1}),
                                            stop("0", 2, {0, 0, -1})};
    EXPECT_EQ(find_camera(cameras, ""), 0u);
    EXPECT_EQ(find_camera(cameras, "b"), 1u);
    EXPECT_EQ(find_camera(cameras, "2"), 2u);
    EXPECT_EQ(find_camera(cameras, "0"), 2u); // a name goes first
    for (const char* bad : {"c", "3", "-1", "1x", "99999999999999999999"})
        EXPECT_THROW(find_camera(cameras, bad), InputError) << bad;
}

TEST(Cameras, WithoutAnyTheBoundsAreFramed) {
    Level level;
    level.bounds = {glm::dvec3(-1), glm::dvec3(1)};
    const auto cameras = usable_cameras(level);
    ASSERT_EQ(cameras.size(), 1u);
    const glm::dvec3 to_center = glm::normalize(-cameras[0].position);
    EXPECT_NEAR(glm::dot(to_center, glm::dvec3(cameras[0].forward)), 1.0, 1e-6);
}

TEST(Flight, PassesThroughItsStops) {
    const Flight flight(
        {stop("a", 0, {0, 0, -1}), stop("b", 1, {1, 0, 0}), stop("c", 4, {0, 0, 1})}, glm::dvec3(0),
        false);
    EXPECT_NEAR(flight.at(0.0).position.x, 0.0, 1e-9);
    EXPECT_NEAR(flight.at(0.5).position.x, 1.0, 1e-9);
    EXPECT_NEAR(flight.at(0.5).forward.x, 1.0f, 1e-5f);
    EXPECT_NEAR(flight.at(1.0).position.x, 4.0, 1e-9);
    EXPECT_NEAR(glm::length(flight.at(0.3).forward), 1.0f, 1e-5f);
}

TEST(Flight, OneStopOrbitsOrTurns) {
    const Viewpoint view = stop("a", 2, {-1, 0, 0});
    EXPECT_NEAR(Flight({view}, glm::dvec3(0), true).at(0.5).position.x, -2.0, 1e-9);
    EXPECT_NEAR(Flight({view}, glm::dvec3(0), false).at(0.5).position.x, 2.0, 1e-9);
    EXPECT_NEAR(Flight({view}, glm::dvec3(0), false).at(0.5).forward.x, 1.0f, 1e-5f);
}

TEST(NumberedName, PutsNumbersWhereTheyBelong) {
    EXPECT_FALSE(NumberedName::parse("shot.png"));
    EXPECT_FALSE(NumberedName::parse("100%.png"));
    EXPECT_FALSE(NumberedName::parse("%s.png"));
    EXPECT_FALSE(NumberedName::parse("%999999d.png"));
    EXPECT_EQ(NumberedName::parse("a_%d.png")->at(7), "a_7.png");
    EXPECT_EQ(NumberedName::parse("a_%04d.png")->at(7), "a_0007.png");
    EXPECT_EQ(NumberedName::parse("a_%04d.png")->at(12345), "a_12345.png");
}

TEST(FrameLog, TakesTheMedian) {
    FrameLog log;
    EXPECT_EQ(log.median_ms(), 0.0);
    EXPECT_EQ(log.mrays_per_second(), 0.0);
    for (const double ms : {5.0, 1.0, 2.0}) {
        rt_frame_stats stats = rt_default_frame_stats();
        stats.frame_ms = ms;
        stats.rays_primary = 1500;
        stats.rays_shadow = 500;
        log.add(stats);
    }
    EXPECT_EQ(log.median_ms(), 2.0);
    EXPECT_EQ(log.worst_ms(), 5.0);
    EXPECT_NEAR(log.mrays_per_second(), 1.0, 1e-12);
}

} // namespace
} // namespace host::test
