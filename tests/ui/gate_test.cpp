#include "ui/gate.h"

#include <gtest/gtest.h>

using namespace host::ui;

namespace {

constexpr double frame = 1.0 / 60;

// What gets through of the same input in each frame of some seconds.
struct Through {
    int up = 0, accept = 0, back = 0, pressed = 0, held = 0;
};

class GateTest : public testing::Test {
protected:
    Through hold(const MenuInput& input, double seconds, const Pointer& pointer = {}) {
        Through through;
        for (int i = 0; i * frame < seconds; ++i) {
            MenuInput passed = input;
            Pointer mouse = pointer;
            gate.pass(passed, mouse, frame);
            passed = repeater.update(passed, frame);
            through.up += passed.up;
            through.accept += passed.accept;
            through.back += passed.back;
            through.pressed += mouse.pressed;
            through.held += mouse.held;
        }
        return through;
    }
    static Pointer mouse(bool pressed, bool held) { return {{}, true, pressed, held, false}; }

    Gate gate;
    Repeater repeater;
};

TEST_F(GateTest, NothingCountsInTheFirstMoments) {
    const MenuInput all{true, true, true, true, true, true};
    for (int i = 0; i < 10; ++i) { // pressed again and again
        const Through down = hold(all, frame, mouse(true, true)), up = hold({}, frame);
        EXPECT_EQ(down.up + down.accept + down.back + down.pressed + up.up, 0) << i;
    }
    hold({}, 0.2);
    const Through later = hold({.accept = true}, frame, mouse(true, true));
    EXPECT_EQ(later.accept, 1);
    EXPECT_EQ(later.pressed, 1);
}

TEST_F(GateTest, WhatIsHeldSinceBeforeNeverCounts) {
    const MenuInput held{.up = true, .accept = true};
    hold(held, 2.0); // while playing, before the screen appears
    gate.shut();
    const Through through = hold(held, 3.0, mouse(false, true));
    EXPECT_EQ(through.up + through.accept + through.held, 0);
    hold({}, frame); // let go
    const Through anew = hold(held, 0.1, mouse(true, true));
    EXPECT_EQ(anew.up, 1);
    EXPECT_EQ(anew.accept, 1);
    EXPECT_GT(anew.held, 0);
}

TEST_F(GateTest, WhatIsPressedInTheFirstMomentsNeverCounts) {
    hold({}, 0.2);
    EXPECT_EQ(hold({.up = true}, 3.0).up, 0);
}

TEST_F(GateTest, AKeyThatIsHeldLeavesTheOthersAlone) {
    hold({.up = true}, 1.0);
    const Through through = hold({.up = true, .accept = true}, 0.1);
    EXPECT_EQ(through.accept, 1);
    EXPECT_EQ(through.up, 0);
}

TEST_F(GateTest, ALongFrameIsNoWayAroundIt) {
    MenuInput input{.accept = true};
    Pointer pointer;
    gate.pass(input, pointer, 5.0); // the frame that the screen appears in took that long
    EXPECT_FALSE(input.accept);
}

} // namespace
