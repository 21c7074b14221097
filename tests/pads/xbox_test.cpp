#include <gtest/gtest.h>

#include "bytes.h"
#include "pads/eightbitdo.h"
#include "pads/xbox.h"

namespace host::pads::test {
namespace {

using enum Button;

TEST(Xbox, TellsTheLayouts) {
    EXPECT_EQ(xbox_layout(0x02e0, 0), XboxLayout::one_s_early);
    EXPECT_EQ(xbox_layout(0x02fd, 10), XboxLayout::one_s_early);
    EXPECT_EQ(xbox_layout(0x02fd, 15), XboxLayout::one_s);
    EXPECT_EQ(xbox_layout(0x0b05, 15), XboxLayout::one_s);
    EXPECT_EQ(xbox_layout(0x0b13, 15), XboxLayout::series);
}

TEST(Xbox, ReadsASeriesPad) {
    // Sticks at rest but left x, right trigger full, hat east, X and LB, View and right stick,
    // Share
    const auto report = bytes("01 ff ff 00 80 00 80 00 80 00 00 ff 03 03 48 44 01");
    const auto state = parse_xbox(report, XboxLayout::series, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons,
              buttons(right, west, left_shoulder, select, right_stick, extra, right_trigger));
    EXPECT_EQ(state->left, (Stick{1.0f, 0.0f}));
    EXPECT_EQ(state->right, Stick{});
    EXPECT_EQ(state->left_trigger, 0.0f);
    EXPECT_EQ(state->right_trigger, 1.0f);
}

TEST(Xbox, ReadsAOneS) {
    const auto report = bytes("01 00 80 00 00 00 80 00 80 ff 01 00 00 00 91 08 01");
    const auto state = parse_xbox(report, XboxLayout::one_s, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons, buttons(south, north, right_shoulder, start, select));
    EXPECT_EQ(state->left, (Stick{0.0f, 1.0f}));
    EXPECT_FLOAT_EQ(state->left_trigger, 511.0f / 1023.0f);
}

TEST(Xbox, ReadsAnEarlyOneS) {
    const auto report = bytes("01 00 80 00 80 00 00 ff ff 00 00 00 00 08 cf 02");
    const auto state = parse_xbox(report, XboxLayout::one_s_early, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons,
              buttons(up, left, south, east, west, north, select, start, right_stick));
    EXPECT_EQ(state->right, (Stick{-1.0f, -1.0f}));
}

TEST(Xbox, KeepsTheGuideOfItsOwnReport) {
    const auto rest = bytes("01 00 80 00 80 00 80 00 80 00 00 00 00 00 00 00 00");
    const auto down = parse_xbox(bytes("02 01"), XboxLayout::one_s, {});
    ASSERT_TRUE(down);
    EXPECT_EQ(down->buttons, buttons(guide));
    EXPECT_EQ(parse_xbox(rest, XboxLayout::one_s, *down)->buttons, buttons(guide));
    EXPECT_EQ(parse_xbox(bytes("02 00"), XboxLayout::one_s, *down)->buttons, Buttons{});
    EXPECT_FALSE(parse_xbox(bytes("02 01"), XboxLayout::series, {})) << "it has no such report";
    EXPECT_FALSE(parse_xbox(bytes("04 8f"), XboxLayout::one_s, {})) << "the battery";
}

TEST(Xbox, RefusesOtherSizes) {
    for (const auto layout : {XboxLayout::one_s_early, XboxLayout::one_s, XboxLayout::series})
        for (const size_t size : {0u, 1u, 15u, 57u, 512u}) {
            std::vector<uint8_t> report(size);
            if (size > 0) report[0] = 1;
            EXPECT_FALSE(parse_xbox(report, layout, {})) << size;
        }
    EXPECT_FALSE(parse_xbox(bytes("01 ..15"), XboxLayout::series, {}));
    EXPECT_FALSE(parse_xbox(bytes("01 ..16"), XboxLayout::one_s_early, {}));
    EXPECT_FALSE(parse_xbox(bytes("03 ..16"), XboxLayout::series, {}));
}

TEST(Xbox, WritesMotors) {
    EXPECT_EQ(xbox_output({1.0f, 0.5f}), bytes("03 03 00 00 64 32 ff 00 eb"));
    EXPECT_EQ(xbox_output({7.0f, -1.0f}), bytes("03 03 00 00 64 00 ff 00 eb"));
}

TEST(EightBitDo, WritesMotors) {
    EXPECT_EQ(eightbitdo_output({1.0f, 0.5f}), bytes("05 ff 80 00 00"));
}

} // namespace
} // namespace host::pads::test
