#include <gtest/gtest.h>

#include "descriptors.h"
#include "pads/driver.h"
#include "pads/eightbitdo.h"
#include "pads/generic.h"
#include "pads/player_mappings.h"

namespace host::pads::test {
namespace {

using enum Button;

GenericReader reader(const std::vector<uint8_t>& descriptor,
                     ButtonOrder order = ButtonOrder::guess) {
    const auto parsed = parse_descriptor(descriptor);
    EXPECT_TRUE(parsed);
    return {*parsed, default_mapping(*parsed, order)};
}

TEST(Generic, TellsPadsFromOtherDevices) {
    EXPECT_TRUE(is_gamepad(*parse_descriptor(plain_descriptor())));
    EXPECT_TRUE(is_gamepad(*parse_descriptor(numbered_descriptor())));
    EXPECT_TRUE(is_gamepad(*parse_descriptor(array_descriptor())));
    EXPECT_FALSE(is_gamepad(*parse_descriptor(mouse_descriptor())));
}

TEST(Generic, ReadsAPlainPad) {
    // Hat north-west, buttons 2 (south), 6, 7 and 10
    const auto state = reader(plain_descriptor()).parse(bytes("00 ff 80 00 27 26 00 00"), {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons,
              buttons(up, left, south, right_shoulder, left_trigger, start).without(buttons()));
    EXPECT_EQ(state->left, (Stick{-1.0f, -1.0f}));
    EXPECT_EQ(state->right, (Stick{0.0f, 1.0f}));
    EXPECT_EQ(state->left_trigger, 1.0f) << "a button is also a trigger";
    EXPECT_EQ(state->right_trigger, 0.0f);
}

TEST(Generic, HatAtRestMeansNoDirection) {
    PadState before;
    before.buttons = buttons(up);
    for (const char* report : {"80 80 80 80 08 00 00 00", "80 80 80 80 0f 00 00 00"})
        EXPECT_EQ(reader(plain_descriptor()).parse(bytes(report), before)->buttons, Buttons{});
}

TEST(Generic, ReadsNumberedReportsOfTheirOwn) {
    const GenericReader pad = reader(numbered_descriptor());
    const auto sticks = pad.parse(bytes("03 ff 7f 00 00 01 80 00 00"), {});
    ASSERT_TRUE(sticks);
    EXPECT_EQ(sticks->left, (Stick{1.0f, 0.0f}));
    EXPECT_EQ(sticks->right, (Stick{-1.0f, 0.0f}));
    // Accelerator 1023, brake 0; buttons 1, 5, 12; hat 3 (east)
    const auto rest = pad.parse(bytes("05 ff 03 00 11 08 03"), *sticks);
    ASSERT_TRUE(rest);
    EXPECT_EQ(rest->left, sticks->left) << "not in this report";
    EXPECT_EQ(rest->right_trigger, 1.0f);
    EXPECT_EQ(rest->left_trigger, 0.0f);
    EXPECT_EQ(rest->buttons, buttons(south, north, start, right));
    EXPECT_FALSE(pad.parse(bytes("04 00 00 00 00 00 00"), {})) << "no such report";
}

TEST(Generic, ReadsArraysAndHatsOfFour) {
    const GenericReader pad = reader(array_descriptor());
    const auto state = pad.parse(bytes("81 7f 02 0a 00 03"), {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->left, (Stick{-1.0f, -1.0f}));
    EXPECT_EQ(state->buttons, buttons(south, start, left));
    const auto next = pad.parse(bytes("00 00 00 00 00 0f"), *state);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->buttons, Buttons{});
}

TEST(Generic, RefusesCutAndOversizedReports) {
    const GenericReader pad = reader(plain_descriptor());
    for (const size_t size : {0u, 1u, 7u, 65u, 512u})
        EXPECT_FALSE(pad.parse(std::vector<uint8_t>(size), {})) << size;
    EXPECT_TRUE(pad.parse(std::vector<uint8_t>(64), {})) << "filled up to the packet";
}

TEST(Mapping, PutsSticksBeforeTriggers) {
    // Six axes X Y Z Rz Rx Ry, as a DualShock describes itself, and X Y Rx Ry Z Rz, as an Xbox pad
    const std::string head = "05 01 09 05 a1 01 15 00 26 ff 00 75 08 95 06 09 30 09 31 ";
    const std::string tail = " 81 02 05 09 19 01 29 0a 25 01 75 01 95 0a 81 02 c0";
    const auto sony = parse_descriptor(bytes(head + "09 32 09 35 09 33 09 34" + tail));
    const Mapping first = default_mapping(*sony, ButtonOrder::guess);
    EXPECT_EQ(first[Axis::right_x], usage::z);
    EXPECT_EQ(first[Axis::left_trigger], usage::rx);
    const auto xbox = parse_descriptor(bytes(head + "09 33 09 34 09 32 09 35" + tail));
    const Mapping second = default_mapping(*xbox, ButtonOrder::guess);
    EXPECT_EQ(second[Axis::right_x], usage::rx);
    EXPECT_EQ(second[Axis::right_trigger], usage::rz);
    EXPECT_EQ(second[south], 1);
    EXPECT_EQ(second[left_stick], 9);
}

TEST(Mapping, IsWrittenAndReadAsText) {
    const auto descriptor = parse_descriptor(plain_descriptor());
    Mapping mapping = default_mapping(*descriptor, ButtonOrder::guess);
    EXPECT_EQ(mapping_text(mapping),
              "south=2 east=3 west=1 north=4 left_shoulder=5 right_shoulder=6 l2=7 r2=8 select=9 "
              "start=10 left_stick=11 right_stick=12 left_x=x left_y=y right_x=z right_y=rz");
    EXPECT_EQ(apply_mapping_text("south=3, east=2 right_x=none", mapping), "");
    EXPECT_EQ(mapping[south], 3);
    EXPECT_EQ(mapping[Axis::right_x], Usage{});
    const Mapping before = mapping;
    for (const char* wrong :
         {"south", "south=", "south=x", "south=99999", "nose=1", "left_x=3", "west=1 left_x=bow"}) {
        EXPECT_NE(apply_mapping_text(wrong, mapping), "") << wrong;
        EXPECT_EQ(mapping, before) << wrong;
    }
    Mapping again;
    again.hat = mapping.hat;
    EXPECT_EQ(apply_mapping_text(mapping_text(mapping), again), "");
    EXPECT_EQ(again, mapping);
}

TEST(EightBitDo, ReadsLettersByPlace) {
    const auto descriptor = parse_descriptor(numbered_descriptor());
    const Mapping nintendo = eightbitdo_mapping(*descriptor, 0x6001); // SN30 Pro
    EXPECT_EQ(nintendo[east], 1);
    EXPECT_EQ(nintendo[south], 2);
    EXPECT_EQ(nintendo[north], 4);
    EXPECT_EQ(nintendo[west], 5);
    EXPECT_EQ(nintendo[guide], 13);
    EXPECT_EQ(eightbitdo_mapping(*descriptor, 0x6012)[south], 1); // Ultimate 2
}

TEST(Generic, ThePlayersMappingWinsOverTheKnownOne) {
    const Identity dragon_rise{0x0079, 0x0006, Bus::usb};
    const auto press_three = bytes("80 80 80 80 48 00 00 00");
    auto driver = make_driver(dragon_rise, plain_descriptor(), "");
    ASSERT_TRUE(driver);
    EXPECT_EQ(driver->receive(press_three, {})->buttons, buttons(south));
    driver = make_driver(dragon_rise, plain_descriptor(), "north=3 south=1");
    EXPECT_EQ(driver->receive(press_three, {})->buttons, buttons(north));
}

TEST(PlayerMappings, AreReadLineByLine) {
    PlayerMappings mappings;
    EXPECT_EQ(parse_player_mappings(
                  "# mine\n\n0079:0006 south=3 east=2 # a pad\r\n 054C:0ce6 west=1", mappings),
              "");
    EXPECT_EQ(mappings, (PlayerMappings{{{0x0079, 0x0006}, " south=3 east=2 "},
                                        {{0x054c, 0x0ce6}, " west=1"}}));
    const PlayerMappings before = mappings;
    for (const char* wrong : {"79:6 south=1", "0079:0006south=1", "x", "0079-0006 south=1",
                              "0079:00g6 south=1", "0079:0006 south=1\n0079:0006 nose=1"})
        EXPECT_NE(parse_player_mappings(wrong, mappings), "") << wrong;
    EXPECT_EQ(mappings, before);
    EXPECT_EQ(parse_player_mappings("\n0079:0006 nose=1", mappings),
              "line 2: nose=1 maps nothing; write, for example, south=2 or right_x=z");
    EXPECT_NE(read_player_mappings("/nowhere/at/all", mappings), "");
    EXPECT_NE(read_player_mappings("/", mappings), "");
}

} // namespace
} // namespace host::pads::test
