#include <gtest/gtest.h>

#include "descriptors.h"
#include "pads/descriptor.h"

namespace host::pads::test {
namespace {

TEST(Descriptor, FindsFieldsAndTheirPlaces) {
    const auto descriptor = parse_descriptor(plain_descriptor());
    ASSERT_TRUE(descriptor);
    EXPECT_TRUE(descriptor->is(usage::gamepad));
    EXPECT_FALSE(descriptor->is(usage::joystick));
    EXPECT_FALSE(descriptor->has_ids);
    EXPECT_EQ(descriptor->input_bits[0], 64u);
    ASSERT_EQ(descriptor->inputs.size(), 17u);
    const InputField* rz = descriptor->find(usage::rz);
    ASSERT_TRUE(rz);
    EXPECT_EQ(rz->bit, 24u);
    EXPECT_EQ(rz->highest, 255) << "two bytes, so that it is not -1";
    const InputField* last = descriptor->find({usage::button, 12});
    ASSERT_TRUE(last);
    EXPECT_EQ(last->bit, 47u);
    EXPECT_FALSE(descriptor->find({usage::button, 13}));
}

TEST(Descriptor, KeepsReportsApart) {
    const auto descriptor = parse_descriptor(numbered_descriptor());
    ASSERT_TRUE(descriptor);
    EXPECT_TRUE(descriptor->has_ids);
    EXPECT_EQ(descriptor->input_bits[3], 64u);
    EXPECT_EQ(descriptor->input_bits[5], 48u);
    EXPECT_EQ(descriptor->find(usage::z)->report, 3);
    EXPECT_EQ(descriptor->find(usage::z)->lowest, -32767);
    EXPECT_EQ(descriptor->find(usage::brake)->report, 5);
    EXPECT_EQ(descriptor->find(usage::brake)->bit, 10u);
    EXPECT_EQ(descriptor->find(usage::hat)->bit, 40u);
    EXPECT_TRUE(descriptor->output_ids.test(9));
    EXPECT_FALSE(descriptor->output_ids.test(5));
}

TEST(Descriptor, ReadsNumbersAcrossBytes) {
    const InputField field{.bit = 3, .bits = 10, .lowest = 0, .highest = 1023};
    EXPECT_EQ(field.read(bytes("f8 1f")), 1023);
    EXPECT_EQ(field.read(bytes("08 00")), 1);
    const InputField negative{.bit = 4, .bits = 8, .lowest = -127, .highest = 127};
    EXPECT_EQ(negative.read(bytes("f0 0f")), -1);
    EXPECT_FALSE(negative.read(bytes("00 08"))) << "-128 is outside";
    const InputField wide{.bits = 32, .lowest = -0x80000000ll, .highest = 0x7fffffff};
    EXPECT_EQ(wide.read(bytes("00 00 00 80")), -0x80000000ll);
}

TEST(Descriptor, MaximumWithoutSignUnlessTheMinimumHasOne) {
    const auto one =
        parse_descriptor(bytes("05 01 09 05 a1 01 15 00 25 ff 75 08 95 01 09 30 81 02"));
    ASSERT_TRUE(one);
    EXPECT_EQ(one->find(usage::x)->highest, 255);
    const auto two =
        parse_descriptor(bytes("05 01 09 05 a1 01 15 81 25 7f 75 08 95 01 09 30 81 02"));
    ASSERT_TRUE(two);
    EXPECT_EQ(two->find(usage::x)->lowest, -127);
}

TEST(Descriptor, PushAndPopKeepTheGlobalItems) {
    const auto descriptor = parse_descriptor(
        bytes("05 01 09 05 a1 01 15 00 25 01 75 08 95 01 a4 05 09 75 01 09 01 81 02 b4 "
              "09 30 81 02 c0"));
    ASSERT_TRUE(descriptor);
    ASSERT_TRUE(descriptor->find(usage::x));
    EXPECT_EQ(descriptor->find(usage::x)->bits, 8);
    EXPECT_EQ(descriptor->find(usage::x)->bit, 1u);
    EXPECT_FALSE(parse_descriptor(bytes("05 01 09 05 a1 01 b4 c0"))) << "nothing was pushed";
}

TEST(Descriptor, TakesExtendedUsagesAlternativesAndLongItems) {
    const auto descriptor = parse_descriptor(
        bytes("05 0c 0b 05 00 01 00 a1 01 fe 02 10 aa bb "
              "15 00 25 7f 75 08 95 01 a9 01 0b 30 00 01 00 0b 33 00 01 00 a9 00 81 02 c0"));
    ASSERT_TRUE(descriptor);
    EXPECT_TRUE(descriptor->is(usage::gamepad));
    EXPECT_TRUE(descriptor->find(usage::x));
    EXPECT_FALSE(descriptor->find(usage::rx)) << "the second alternative";
}

TEST(Descriptor, LeavesOutWhatTellsNothing) {
    const auto mouse = parse_descriptor(mouse_descriptor());
    ASSERT_TRUE(mouse);
    EXPECT_FALSE(mouse->find(usage::x)) << "relative";
    EXPECT_EQ(mouse->inputs.size(), 3u) << "buttons without padding";
    EXPECT_EQ(mouse->input_bits[0], 24u);
}

std::vector<uint8_t> in_gamepad(const std::string& items) {
    return bytes("05 01 09 05 a1 01 " + items);
}

TEST(Descriptor, RefusesHostileOnes) {
    EXPECT_FALSE(parse_descriptor({}));
    EXPECT_FALSE(parse_descriptor(bytes("00")));
    EXPECT_FALSE(parse_descriptor(std::vector<uint8_t>(5000, 0x05))) << "long";
    EXPECT_FALSE(parse_descriptor(in_gamepad("26 ff"))) << "cut off";
    EXPECT_FALSE(parse_descriptor(in_gamepad("fe 20 10"))) << "a long item, cut off";
    EXPECT_FALSE(parse_descriptor(in_gamepad("c0 c0"))) << "more ends than beginnings";
    EXPECT_FALSE(parse_descriptor(in_gamepad("85 00"))) << "report id 0";
    EXPECT_FALSE(parse_descriptor(in_gamepad("77 ff ff ff ff"))) << "report size";
    EXPECT_FALSE(parse_descriptor(in_gamepad("97 ff ff ff 7f 75 20 09 30 81 02"))) << "count";
    EXPECT_FALSE(parse_descriptor(in_gamepad("75 10 96 00 0f 09 30 81 02")))
        << "60,000 bits are too many";
    EXPECT_FALSE(parse_descriptor(in_gamepad("1b 00 00 00 00 2b ff ff ff ff"))) << "usage range";
    EXPECT_FALSE(parse_descriptor(in_gamepad("2a ff 00"))) << "an end without a beginning";
    std::string deep, pushed;
    for (int i = 0; i < 17; ++i) deep += "a1 00 ", pushed += "a4 ";
    EXPECT_FALSE(parse_descriptor(in_gamepad(deep)));
    EXPECT_FALSE(parse_descriptor(in_gamepad(pushed)));
    EXPECT_FALSE(parse_descriptor(in_gamepad("15 00 25 01 75 01 96 01 04 09 30 81 00")))
        << "an array of 1025 elements";
}

} // namespace
} // namespace host::pads::test
