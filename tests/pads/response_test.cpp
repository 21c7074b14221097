#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "pads/response.h"

namespace host::pads::test {
namespace {

std::vector<Response> many_responses() {
    std::vector<Response> responses = {{}, {0.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 1.0f}};
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(0.0f, 1.0f);
    for (int i = 0; i < 50; ++i)
        responses.push_back({0.5f * part(random), 0.6f + 0.4f * part(random), part(random)});
    return responses;
}

TEST(Response, NothingInsideAndEverythingAtTheEdge) {
    for (const Response& response : many_responses()) {
        EXPECT_EQ(respond(0.0f, response), 0.0f);
        EXPECT_EQ(respond(response.inner, response), 0.0f);
        EXPECT_EQ(respond(response.outer, response), 1.0f);
        EXPECT_EQ(respond(1.0f, response), 1.0f);
        EXPECT_EQ(respond(1.5f, response), 1.0f);
    }
}

TEST(Response, IsMonotoneAndContinuous) {
    constexpr int steps = 20000;
    for (const Response& response : many_responses()) {
        // The steepest slope: of the cubic at the edge, over the part that is left
        const float slope = (1.0f + 2.0f * response.curve) / (response.outer - response.inner);
        float before = respond(0.0f, response);
        for (int i = 1; i <= steps; ++i) {
            const float now = respond(static_cast<float>(i) / steps, response);
            EXPECT_GE(now, before);
            EXPECT_LE(now - before, 1.01f * slope / steps + 1e-6f);
            before = now;
        }
    }
}

TEST(Response, RoundDeadZoneKeepsTheDirection) {
    const Response response{0.2f, 0.9f, 0.5f};
    std::mt19937 random(8);
    std::uniform_real_distribution<float> part(-1.0f, 1.0f);
    for (int i = 0; i < 10000; ++i) {
        const Stick stick{part(random), part(random)};
        const Stick result = respond(stick, response);
        const float length = std::hypot(stick.x, stick.y);
        if (length < response.inner) {
            EXPECT_EQ(result, Stick{});
            continue;
        }
        EXPECT_NEAR(stick.x * result.y - stick.y * result.x, 0.0f, 1e-6f);
        EXPECT_GE(stick.x * result.x + stick.y * result.y, 0.0f);
        EXPECT_NEAR(std::hypot(result.x, result.y), respond(length, response), 1e-6f);
    }
}

TEST(Response, NonsenseIsBentToSense) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Response& response : {Response{nan, nan, nan}, Response{2.0f, -1.0f, 9.0f},
                                     Response{1.0f, 1.0f, 1.0f}, Response{-5.0f, 0.0f, -1.0f}})
        for (const float way : {0.0f, 0.3f, 1.0f, 1.4f, nan}) {
            const float result = respond(way, response);
            EXPECT_GE(result, 0.0f);
            EXPECT_LE(result, 1.0f);
        }
    EXPECT_EQ(respond(Stick{nan, 0.0f}, Response{}), Stick{});
}

TEST(Response, AppliesToAllOfAPad) {
    PadState state;
    state.left = {0.05f, 0.0f};
    state.right = {0.0f, -1.0f};
    state.left_trigger = 0.01f;
    state.right_trigger = 1.0f;
    state.buttons.set(Button::start);
    const PadState result = respond(state, PadResponse{});
    EXPECT_EQ(result.left, Stick{});
    EXPECT_EQ(result.right, (Stick{0.0f, -1.0f}));
    EXPECT_EQ(result.left_trigger, 0.0f);
    EXPECT_EQ(result.right_trigger, 1.0f);
    EXPECT_EQ(result.buttons, state.buttons);
}

} // namespace
} // namespace host::pads::test
