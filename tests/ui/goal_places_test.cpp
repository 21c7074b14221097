#include "ui/goal_places.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

using namespace host;
using namespace host::ui;

namespace {

constexpr float wide = 1280.0f, high = 720.0f, unit = 1.0f;

Viewpoint north() { // along -Z from the eye's height
    Viewpoint view;
    view.position = {0.0, 1.7, 0.0};
    return view;
}

GoalMark goal_at(const glm::dvec3& place) {
    return {Projection(north(), 1280, 720).sight(place), "CORE"};
}

std::vector<GoalPlace> placed(const std::vector<GoalMark>& goals, std::vector<Box> taken = {}) {
    std::vector<glm::vec2> sizes;
    for (const GoalMark& goal : goals)
        sizes.emplace_back(8.0f * static_cast<float>(goal_text(goal).size()), 19.0f);
    return place_goals(goals, sizes, {wide, high}, unit, std::move(taken));
}

TEST(GoalPlaces, InViewItIsWhereItIs) {
    const GoalMark goal = goal_at({1.0, 1.7, -10.0});
    const auto places = placed({goal});
    EXPECT_EQ(places[0].mark, goal.sight.place);
    EXPECT_EQ(places[0].out, glm::vec2(0.0f));
    EXPECT_EQ(goal_text(goal), "CORE  10 m");
}

//             above
//        +-------------+
//   left |      ^      | right      behind: at the bottom, to the side of the shorter turn
//        +-------------+
//          below, behind
TEST(GoalPlaces, OutOfViewItIsAtTheEdge) {
    const auto one = [](const glm::dvec3& place) { return placed({goal_at(place)})[0]; };
    const GoalPlace right = one({10.0, 1.7, -1.0}), left = one({-10.0, 1.7, -1.0});
    EXPECT_GT(right.mark.x, wide - 60.0f);
    EXPECT_NEAR(right.mark.y, 0.5f * high, 40.0f);
    EXPECT_GT(right.out.x, 0.9f);
    EXPECT_LT(left.mark.x, 60.0f);
    EXPECT_LT(left.out.x, -0.9f);
    const GoalPlace behind = one({1.0, 1.7, 10.0});
    EXPECT_GT(behind.mark.y, 0.7f * high);
    EXPECT_GT(behind.out.y, 0.9f);
    EXPECT_GT(behind.mark.x, 0.5f * wide);
    const GoalPlace above = one({0.1, 12.0, -1.0}), over = one({0.1, 12.0, 1.0});
    for (const GoalPlace& place : {above, over}) {
        EXPECT_LT(place.mark.y, 0.3f * high);
        EXPECT_LT(place.out.y, -0.9f);
    }
    const GoalPlace below = one({0.1, -9.0, -1.0});
    EXPECT_GT(below.mark.y, 0.7f * high);
    const GoalPlace exact = one({0.0, 1.7, 5.0}); // straight behind
    EXPECT_TRUE(std::isfinite(exact.mark.x) && exact.mark.y > 0.7f * high);
}

TEST(GoalPlaces, ItSaysWhereToLook) {
    EXPECT_EQ(whereabouts(goal_at({10.0, 1.7, -1.0}).sight), "");
    EXPECT_EQ(whereabouts(goal_at({0.1, 12.0, -1.0}).sight), "above");
    EXPECT_EQ(whereabouts(goal_at({12.0, 6.0, -1.0}).sight), "above");
    EXPECT_EQ(whereabouts(goal_at({0.1, -9.0, 1.0}).sight), "below");
    EXPECT_EQ(whereabouts(goal_at({1.0, 1.2, 10.0}).sight), "behind");
    EXPECT_EQ(whereabouts(goal_at({1.0, -4.0, 10.0}).sight), "below, behind");
    EXPECT_EQ(whereabouts(goal_at({1.0, 6.0, -12.0}).sight), "") << "in view";
    EXPECT_EQ(goal_text(goal_at({3.0, 1.7, 4.0})), "CORE  5 m  behind");
}

TEST(GoalPlaces, TextsKeepOffTheClock) {
    const Box clock{{510.0f, 0.0f}, {770.0f, 102.0f}};
    for (double y = 4.0; y < 7.0; y += 0.1) {
        const auto places = placed({goal_at({0.0, y, -9.0})}, {clock});
        EXPECT_FALSE(places[0].label.overlaps(clock)) << y;
    }
}

// Nothing lies on anything, whatever there is in whatever direction.
TEST(GoalPlaces, NoTwoTextsMeet) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> way(-15.0, 15.0);
    const std::vector<Box> hud = {{{0.0f, 0.0f}, {182.0f, 88.0f}},
                                  {{510.0f, 0.0f}, {770.0f, 102.0f}},
                                  {{1098.0f, 0.0f}, {wide, 84.0f}},
                                  {{0.0f, 636.0f}, {wide, high}}};
    const Box window{{0.0f, 0.0f}, {wide, high}};
    for (int round = 0; round < 500; ++round) {
        std::vector<GoalMark> goals;
        const glm::dvec3 near(way(random), 0.4 * way(random), way(random));
        for (int i = 0; i < 5; ++i) // some of them close together
            goals.push_back(goal_at(i < 3
                                        ? near + glm::dvec3(0.3 * i, 0.1 * i, 0.0)
                                        : glm::dvec3(way(random), 0.4 * way(random), way(random))));
        const auto places = placed(goals, hud);
        for (size_t i = 0; i < places.size(); ++i) {
            const Box& label = places[i].label;
            EXPECT_TRUE(window.contains(label.lower) && window.contains(label.upper)) << round;
            for (const Box& box : hud) EXPECT_FALSE(label.overlaps(box)) << round;
            for (size_t k = 0; k < i; ++k)
                EXPECT_FALSE(label.overlaps(places[k].label)) << round << ": " << i << " " << k;
        }
    }
}

} // namespace
