#include <gtest/gtest.h>

#include "bytes.h"
#include "pads/crc32.h"
#include "pads/dualsense.h"
#include "pads/dualshock4.h"

namespace host::pads::test {
namespace {

using enum Button;

std::vector<uint8_t> signed_input(std::vector<uint8_t> report) {
    const uint32_t crc = crc32(bluetooth_input, Bytes(report).first(74));
    for (size_t i = 0; i < 4; ++i) report[74 + i] = static_cast<uint8_t>(crc >> 8 * i);
    return report;
}

TEST(Crc32, HasTheCheckValueOfTheStandard) {
    const uint8_t rest[] = {'2', '3', '4', '5', '6', '7', '8', '9'};
    EXPECT_EQ(crc32('1', rest), 0xcbf43926u);
}

// Sticks left x, y, right x, y; hat and faces; shoulders; PS; triggers; then time, temperature and
// the gyroscope.
const char* const dualshock4_body = "00 ff 80 00 28 a3 01 40 ff 12 34 05 e8 03 18 fc 00 00 ..14";

void expect_dualshock4(const PadState& state) {
    EXPECT_EQ(state.buttons,
              buttons(south, left_shoulder, right_shoulder, start, guide, right_stick));
    EXPECT_EQ(state.left, (Stick{-1.0f, -1.0f}));
    EXPECT_EQ(state.right, (Stick{0.0f, 1.0f}));
    EXPECT_FLOAT_EQ(state.left_trigger, 64.0f / 255.0f);
    EXPECT_EQ(state.right_trigger, 1.0f);
}

TEST(DualShock4, ReadsUsb) {
    auto report = bytes(std::string("01 ") + dualshock4_body);
    report.resize(64);
    const auto state = parse_dualshock4(report, {});
    ASSERT_TRUE(state);
    expect_dualshock4(*state);
    ASSERT_TRUE(state->gyro);
    // 1000 and -1000 of 32768 counts for 2000 degrees a second
    EXPECT_NEAR((*state->gyro)[0], 1.0652644, 1e-5);
    EXPECT_NEAR((*state->gyro)[1], -1.0652644, 1e-5);
    EXPECT_EQ((*state->gyro)[2], 0.0f);
}

TEST(DualShock4, ReadsBluetoothWithItsSignature) {
    auto report = bytes(std::string("11 c0 00 ") + dualshock4_body);
    report.resize(78);
    EXPECT_FALSE(parse_dualshock4(report, {})) << "not signed";
    report = signed_input(report);
    const auto state = parse_dualshock4(report, {});
    ASSERT_TRUE(state);
    expect_dualshock4(*state);
    report[20] ^= 1;
    EXPECT_FALSE(parse_dualshock4(report, {})) << "damaged";
}

TEST(Sony, ReadsTheSimpleReport) {
    // Hat south-east and triangle; select; touchpad, with a counter above it
    const auto report = bytes("01 80 80 ff 80 83 10 fe 00 00");
    for (const auto& state : {parse_dualshock4(report, {}), parse_dualsense(report, {})}) {
        ASSERT_TRUE(state);
        EXPECT_EQ(state->buttons, buttons(north, right, down, select, touchpad));
        EXPECT_EQ(state->left, Stick{});
        EXPECT_EQ(state->right, (Stick{1.0f, 0.0f}));
        EXPECT_FALSE(state->gyro);
    }
}

TEST(DualSense, ReadsUsb) {
    // Hat north, circle; L2 R2 create; PS, touchpad and microphone; a yaw of 16384 counts
    auto report = bytes("01 80 80 80 80 20 ff 07 40 1c 07 00 ..4 00 00 00 40 00 00");
    report.resize(64);
    const auto state = parse_dualsense(report, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons,
              buttons(up, east, left_trigger, right_trigger, select, guide, touchpad, extra));
    EXPECT_FLOAT_EQ(state->left_trigger, 32.0f / 255.0f);
    EXPECT_EQ(state->right_trigger, 1.0f);
    EXPECT_NEAR((*state->gyro)[1], 17.453293, 1e-4);
}

TEST(DualSense, ReadsBluetoothWithItsSignature) {
    auto report = bytes("31 01 ff 00 80 80 00 00 01 17");
    report.resize(78);
    EXPECT_FALSE(parse_dualsense(report, {}));
    report = signed_input(report);
    const auto state = parse_dualsense(report, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->left, (Stick{1.0f, 1.0f}));
    EXPECT_EQ(state->buttons, buttons(left, up, west));
}

TEST(Sony, RefusesOtherSizes) {
    for (const uint8_t id : bytes("01 11 31 00"))
        for (const size_t size : {0u, 1u, 9u, 11u, 63u, 65u, 77u, 79u, 512u}) {
            std::vector<uint8_t> report(size);
            if (size > 0) report[0] = id;
            EXPECT_FALSE(parse_dualshock4(report, {})) << size;
            EXPECT_FALSE(parse_dualsense(report, {})) << size;
        }
}

TEST(Sony, CalibratesTheGyroscope) {
    // Bias 10, 0, -10; at +-540 degrees a second 8000 and -8000 counts from the bias
    const auto by_axis = bytes("05 0a 00 00 00 f6 ff 4a 1f ca e0 40 1f c0 e0 36 1f b6 e0 "
                               "1c 02 1c 02 ..18");
    const auto by_sign = bytes("05 0a 00 00 00 f6 ff 4a 1f 40 1f 36 1f ca e0 c0 e0 b6 e0 "
                               "1c 02 1c 02 ..18");
    for (const auto& scale : {parse_sony_calibration(by_axis, GyroOrder::by_axis),
                              parse_sony_calibration(by_sign, GyroOrder::by_sign)}) {
        ASSERT_TRUE(scale);
        const auto rates = scale->rates(bytes("4a 1f 00 00 b6 e0"), 0);
        EXPECT_NEAR(rates[0], 9.424778, 1e-5); // 540 degrees
        EXPECT_EQ(rates[1], 0.0f);
        EXPECT_NEAR(rates[2], -9.424778, 1e-5);
    }
    EXPECT_FALSE(parse_sony_calibration(bytes("05 ..21"), GyroOrder::by_axis)) << "short";
    EXPECT_FALSE(parse_sony_calibration(bytes("05 ..40"), GyroOrder::by_axis)) << "all zero";
}

TEST(DualShock4, WritesMotorsAndLight) {
    const Rumble rumble{1.0f, 0.5f};
    const Color light{1, 2, 3};
    EXPECT_EQ(dualshock4_usb_output(rumble, light), bytes("05 03 00 00 80 ff 01 02 03 ..23"));
    auto expected = bytes("11 c4 00 03 00 00 80 ff 01 02 03 ..67");
    const uint32_t crc = crc32(bluetooth_output, Bytes(expected).first(74));
    for (size_t i = 0; i < 4; ++i) expected[74 + i] = static_cast<uint8_t>(crc >> 8 * i);
    EXPECT_EQ(dualshock4_bluetooth_output(rumble, light), expected);
}

TEST(DualSense, WritesMotorsAndLight) {
    DualSenseEffects effects{{1.0f, 0.25f}, {9, 8, 7}, false, false};
    EXPECT_EQ(dualsense_usb_output(effects),
              bytes("02 03 04 40 ff ..34 00 00 00 00 00 00 09 08 07 ..15"));
    effects.new_vibration = true;
    effects.end_light_show = true;
    const auto report = dualsense_bluetooth_output(effects, 0x13);
    auto expected = bytes("31 30 10 02 04 40 ff ..34 06 00 00 02 00 00 09 08 07 ..28");
    const uint32_t crc = crc32(bluetooth_output, Bytes(expected).first(74));
    for (size_t i = 0; i < 4; ++i) expected[74 + i] = static_cast<uint8_t>(crc >> 8 * i);
    EXPECT_EQ(report, expected);
}

TEST(DualSense, KnowsNewFirmware) {
    auto firmware = bytes("20 ..63");
    EXPECT_FALSE(has_new_vibration(firmware));
    firmware[44] = 0x15;
    firmware[45] = 0x02;
    EXPECT_TRUE(has_new_vibration(firmware));
    firmware.resize(45);
    EXPECT_FALSE(has_new_vibration(firmware));
}

} // namespace
} // namespace host::pads::test
