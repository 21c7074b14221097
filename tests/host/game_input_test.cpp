#include <gtest/gtest.h>

#include "game/input.h"
#include "game/look.h"
#include "gameplay/three_cores/rules.h"

// From keys, mouse and pads to what the player wants.
namespace host::test {
namespace {

using game::Input;
using game::Intent;
using game::Look;

constexpr double frame = 1.0 / 60;

class GameInput : public testing::Test {
protected:
    GameInput() {
        pad.id = 1;
        pad.name = "Test pad";
        pad.prompts = pads::Prompts(pads::PromptStyle::dualsense);
    }

    Intent read(bool with_pad = true) {
        const Intent intent = input.read(desk, with_pad ? &pad : nullptr, settings, frame);
        desk.pressed.clear();
        desk.motion = glm::vec2(0);
        pad.pressed = pad.released = {};
        return intent;
    }
    void press(Key key) {
        desk.held.set(key);
        desk.pressed.set(key);
    }
    void press(pads::Button button) {
        pad.state.buttons.set(button);
        pad.pressed.set(button);
    }

    Input input;
    Desk desk;
    pads::Pad pad;
    PlayerSettings settings;
};

TEST_F(GameInput, KeysAreButtonsOfTheGame) {
    const std::pair<Key, uint32_t> keys[] = {
        {Key::shift, three_cores::kRun},   {Key::control, three_cores::kCrouch},
        {Key::c, three_cores::kCrouch},    {Key::space, three_cores::kJump},
        {Key::mouse, three_cores::kThrow}, {Key::g, three_cores::kThrow},
        {Key::e, three_cores::kUse}};
    for (const auto& [key, button] : keys) {
        press(key);
        EXPECT_EQ(read().buttons, button);
        EXPECT_EQ(read().buttons, button); // as long as it is held
        desk.held.clear();
        EXPECT_EQ(read().buttons, 0u);
    }
}

TEST_F(GameInput, AKeyThatIsUpAgainWithinAFrameCounts) {
    desk.pressed.set(Key::e);
    EXPECT_EQ(read().buttons, three_cores::kUse);
    EXPECT_EQ(read().buttons, 0u);
}

TEST_F(GameInput, DiagonalsAreNoFaster) {
    press(Key::w);
    press(Key::d);
    const Intent intent = read();
    EXPECT_NEAR(glm::length(intent.walk), 1.0f, 1e-6f);
    EXPECT_GT(intent.walk.x, 0.0f);
    EXPECT_GT(intent.walk.y, 0.0f);
}

TEST_F(GameInput, TheMouseTurnsByTheSettings) {
    desk.motion = {100, 50}; // to the right and down
    const Intent plain = read();
    EXPECT_LT(plain.turn.x, 0.0);
    EXPECT_LT(plain.turn.y, 0.0);
    settings.sensitivity = 2;
    settings.invert_look = true;
    desk.motion = {100, 50};
    const Intent other = read();
    EXPECT_NEAR(other.turn.x, 2 * plain.turn.x, 1e-9);
    EXPECT_NEAR(other.turn.y, -2 * plain.turn.y, 1e-9);
}

TEST_F(GameInput, ASticksWayIsAnalogue) {
    pad.state.left = {0.0f, 0.5f};
    const float half = read().walk.y;
    pad.state.left = {0.0f, 1.0f};
    EXPECT_GT(half, 0.05f);
    EXPECT_LT(half, 0.9f);
    EXPECT_NEAR(read().walk.y, 1.0f, 1e-6f);
    pad.state.left = {0.05f, 0.0f}; // in the dead zone
    EXPECT_EQ(read().walk, glm::vec2(0));
}

TEST_F(GameInput, TheRightStickLooks) {
    pad.state.right = {1.0f, 0.0f};
    EXPECT_LT(read().turn.x, 0.0);
    pad.state.right = {0.0f, 1.0f};
    EXPECT_GT(read().turn.y, 0.0);
}

TEST_F(GameInput, ATriggerHoldsTheGrenade) {
    pad.state.right_trigger = 1.0f;
    EXPECT_EQ(read().buttons, three_cores::kThrow);
    pad.state.right_trigger = 0.1f;
    EXPECT_EQ(read().buttons, 0u);
}

TEST_F(GameInput, CrouchingWithAPadIsAToggleUntilTheRun) {
    press(pads::Button::east);
    EXPECT_EQ(read().buttons, three_cores::kCrouch);
    pad.state.buttons = {};
    EXPECT_EQ(read().buttons, three_cores::kCrouch);
    press(pads::Button::left_shoulder);
    EXPECT_EQ(read().buttons, three_cores::kRun);
    pad.state.buttons = {};
    EXPECT_EQ(read().buttons, 0u);
}

TEST_F(GameInput, APressedStickRunsUntilItRests) {
    pad.state.left = {0.0f, 1.0f};
    press(pads::Button::left_stick);
    EXPECT_EQ(read().buttons, three_cores::kRun);
    pad.state.buttons = {};
    EXPECT_EQ(read().buttons, three_cores::kRun);
    pad.state.left = {};
    EXPECT_EQ(read().buttons, 0u);
    pad.state.left = {0.0f, 1.0f};
    EXPECT_EQ(read().buttons, 0u);
}

TEST_F(GameInput, MenusAndPausesOfBoth) {
    press(pads::Button::start);
    EXPECT_TRUE(read().pause);
    press(pads::Button::select);
    EXPECT_TRUE(read().options);
    press(pads::Button::south);
    EXPECT_TRUE(read().menu.accept);
    EXPECT_FALSE(read().menu.accept);
    press(Key::escape);
    const Intent escape = read();
    EXPECT_TRUE(escape.pause && escape.menu.back);
    pad.state.left = {0.0f, -1.0f};
    EXPECT_TRUE(read().menu.down);
    press(Key::f12);
    EXPECT_TRUE(read().screenshot);
}

TEST_F(GameInput, PromptsFollowTheDeviceThatWasUsedLast) {
    read();
    EXPECT_EQ(input.use_key(), "E");
    EXPECT_FALSE(input.uses_pad());
    press(pads::Button::south);
    read();
    EXPECT_TRUE(input.uses_pad());
    EXPECT_EQ(input.device().name, "Test pad");
    EXPECT_EQ(input.device().accept, "Cross");
    EXPECT_EQ(input.use_key(), "Square");
    desk.motion = {1, 0}; // a shaken table
    read();
    EXPECT_TRUE(input.uses_pad());
    press(Key::w);
    read();
    EXPECT_EQ(input.use_key(), "E");
    press(pads::Button::south);
    read();
    read(false); // pulled out
    EXPECT_FALSE(input.uses_pad());
}

TEST(GameLook, DirectionsAreUnitAndWalksAtMostThat) {
    Look look;
    for (int i = 0; i < 500; ++i) {
        look.turn({0.37, i % 2 == 0 ? 0.21 : -0.17});
        const gameplay::TickInput input = look.input({0.6f, 0.8f}, three_cores::kRun);
        const glm::vec3 view(input.view[0], input.view[1], input.view[2]);
        EXPECT_NEAR(glm::length(view), 1.0f, 1e-6f);
        EXPECT_LE(input.walk[0] * input.walk[0] + input.walk[1] * input.walk[1], 1.0f);
        EXPECT_EQ(input.buttons, three_cores::kRun);
    }
}

TEST(GameLook, AheadIsWhereItLooks) {
    Look look;
    look.face({1, 0, 0});
    const gameplay::TickInput ahead = look.input({0, 1}, 0);
    EXPECT_NEAR(ahead.walk[0], 1, 1e-6f);
    EXPECT_NEAR(ahead.walk[1], 0, 1e-6f);
    const gameplay::TickInput right = look.input({1, 0}, 0);
    EXPECT_NEAR(right.walk[1], 1, 1e-6f); // +Z is to the right of +X
    look.turn({0, 10});                   // no somersaults
    EXPECT_LT(look.direction().y, 1.0f);
}

} // namespace
} // namespace host::test
