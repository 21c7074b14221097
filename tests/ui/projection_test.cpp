#include "ui/projection.h"

#include <cmath>

#include <gtest/gtest.h>

using namespace host;
using namespace host::ui;

namespace {

constexpr float pi = 3.14159265f;

Viewpoint east() { // looks along +X from (10, 2, 0); right is +Z
    Viewpoint view;
    view.position = {10.0, 2.0, 0.0};
    view.forward = {1.0f, 0.0f, 0.0f};
    view.vertical_fov = 0.5f * pi;
    return view;
}

TEST(Projection, APointLiesWhereThePinholeSeesIt) {
    const Projection projection(east(), 800, 600);
    const auto ahead = projection.place({15.0, 2.0, 0.0});
    ASSERT_TRUE(ahead);
    EXPECT_NEAR(ahead->x, 400.0f, 1e-3);
    EXPECT_NEAR(ahead->y, 300.0f, 1e-3);
    const auto corner = projection.place({15.0, 7.0, 5.0}); // 45 degrees up: the upper edge
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->x, 700.0f, 1e-2);
    EXPECT_NEAR(corner->y, 0.0f, 1e-2);
    EXPECT_FALSE(projection.place({5.0, 2.0, 0.0}));
}

TEST(Projection, BearingsTurnToTheRight) {
    const Projection projection(east(), 800, 600);
    EXPECT_NEAR(projection.sight({15.0, 2.0, 0.0}).bearing, 0.0f, 1e-4);
    const Sight right = projection.sight({10.0, 9.0, 4.0});
    EXPECT_NEAR(right.bearing, 0.5f * pi, 1e-4);
    EXPECT_FALSE(right.in_view);
    EXPECT_NEAR(right.distance, std::sqrt(49.0f + 16.0f), 1e-4);
    EXPECT_NEAR(std::abs(projection.sight({5.0, 2.0, 0.0}).bearing), pi, 1e-4);
    EXPECT_TRUE(projection.sight({15.0, 3.0, 1.0}).in_view);
    EXPECT_FALSE(projection.sight({15.0, 12.0, 0.0}).in_view) << "above the window";
}

TEST(Projection, LookingStraightDownIsNoTrouble) {
    Viewpoint view = east();
    view.forward = {0.0f, -1.0f, 0.0f};
    const Sight sight = Projection(view, 800, 600).sight({10.5, -3.0, 0.2});
    EXPECT_TRUE(sight.in_view);
    EXPECT_TRUE(std::isfinite(sight.bearing));
}

TEST(Arc, IsBrokenWhereItPassesTheEye) {
    const Projection projection(east(), 800, 600);
    const std::vector<glm::dvec3> way = {{12, 2, 0}, {11, 2, 0}, {9, 2, 0}, {12, 1, 0}, {14, 0, 0}};
    const Arc arc = project_arc(projection, way, 1.0);
    ASSERT_EQ(arc.runs.size(), 2u);
    EXPECT_EQ(arc.runs[0].size(), 2u);
    EXPECT_EQ(arc.runs[1].size(), 2u);
    ASSERT_TRUE(arc.end);
    EXPECT_EQ(*arc.end, *projection.place({14, 0, 0}));
    EXPECT_GT(arc.ring.size(), 12u);
    EXPECT_TRUE(project_arc(projection, {}, 1.0).runs.empty());
    EXPECT_FALSE(project_arc(projection, {}, 1.0).end);
}

TEST(Arc, ARingAroundTheEyeIsNotDrawn) {
    const std::vector<glm::dvec3> way = {{12, 2, 0}, {10.5, 0, 0}};
    EXPECT_TRUE(project_arc(Projection(east(), 800, 600), way, 1.0).ring.empty());
}

} // namespace
