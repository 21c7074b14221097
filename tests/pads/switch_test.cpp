#include <gtest/gtest.h>

#include "bytes.h"
#include "pads/switch_commands.h"
#include "pads/switch_pro.h"

namespace host::pads::test {
namespace {

using enum Button;

// Left: above 1400 x 1300, centre 2000 x 2100, below 1200 x 1100; right: centre 1900 x 2200, below
// 1000 x 1150, above 1500 x 1450. Twelve bits each, two in three bytes.
const char* const left_flash = "78 45 51 d0 47 83 b0 c4 44";
const char* const right_flash = "6c 87 89 e8 e3 47 dc a5 5a";
const SwitchSticks calibrated{
    {2000, 1200, 1400}, {2100, 1100, 1300}, {1900, 1000, 1500}, {2200, 1150, 1450}};

TEST(SwitchPro, ReadsTheFlash) {
    const auto factory = bytes(std::string(left_flash) + " " + right_flash);
    EXPECT_EQ(with_factory_sticks({}, factory), calibrated);
    EXPECT_EQ(with_factory_sticks({}, Bytes(factory).first(17)), SwitchSticks{}) << "short";
    EXPECT_EQ(with_factory_sticks({}, std::vector<uint8_t>(18, 0xff)), SwitchSticks{}) << "erased";
    EXPECT_EQ(with_factory_sticks({}, std::vector<uint8_t>(18, 0)), SwitchSticks{}) << "absurd";

    const std::string mark = "b2 a1 ", none = "ff ff ";
    const auto both = bytes(mark + left_flash + " " + mark + right_flash);
    EXPECT_EQ(with_user_sticks({}, both), calibrated);
    SwitchSticks right_only;
    right_only.right_x = calibrated.right_x;
    right_only.right_y = calibrated.right_y;
    const auto one = bytes(none + left_flash + " " + mark + right_flash);
    EXPECT_EQ(with_user_sticks({}, one), right_only);
    EXPECT_EQ(with_user_sticks(calibrated, std::vector<uint8_t>(22, 0xff)), calibrated);
}

TEST(SwitchPro, ReadsTheFullReport) {
    // A and ZR; minus and left stick; up and ZL. Left stick 2700 x 1000, right 900 x 2200.
    // Three samples of 1000 counts about the first axis of the gyroscope.
    const auto report = bytes("30 55 8e 88 09 82 8c 8a 3e 84 83 89 0c "
                              "..6 e8 03 00 00 00 00 ..6 e8 03 00 00 00 00 ..6 e8 03 00 00 00 00");
    ASSERT_EQ(report.size(), 49u);
    const auto state = parse_switch(report, calibrated);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons, buttons(east, right_trigger, select, left_stick, up, left_trigger));
    EXPECT_EQ(state->left, (Stick{0.5f, -1.0f}));
    EXPECT_EQ(state->right, (Stick{-1.0f, 0.0f}));
    EXPECT_EQ(state->left_trigger, 1.0f);
    EXPECT_EQ(state->right_trigger, 1.0f);
    ASSERT_TRUE(state->gyro);
    EXPECT_NEAR((*state->gyro)[2], -1.2217305, 1e-5); // 70 degrees
    EXPECT_EQ((*state->gyro)[0], 0.0f);
    EXPECT_EQ((*state->gyro)[1], 0.0f);
}

TEST(SwitchPro, UsesDefaultsWithoutCalibration) {
    const auto report =
        bytes("30 00 8e 00 00 00 d0 07 7d d0 f7 01 00 ..36"); // 2000 x 2000, 2000 x 31
    const auto state = parse_switch(report, {});
    ASSERT_TRUE(state);
    EXPECT_EQ(state->left, Stick{});
    EXPECT_EQ(state->right, (Stick{0.0f, -1.0f}));
}

TEST(SwitchPro, ReadsTheSimpleReport) {
    // B and ZL; home and capture; hat west; left stick fully left and up
    const auto report = bytes("3f 41 30 06 00 00 00 00 00 80 ff ff");
    const auto state = parse_switch(report, calibrated);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->buttons, buttons(south, left_trigger, guide, extra, Button::left));
    EXPECT_EQ(state->left, (Stick{-1.0f, 1.0f}));
    EXPECT_EQ(state->right, (Stick{0.0f, -1.0f}));
}

TEST(SwitchPro, RefusesOtherReports) {
    for (const uint8_t id : bytes("30 21 3f 31 81 00"))
        for (const size_t size : {0u, 1u, 11u, 48u, 65u, 362u}) {
            if (id == 0x3f && size == 48) continue; // a padded one is fine
            std::vector<uint8_t> report(size);
            if (size > 0) report[0] = id;
            EXPECT_FALSE(parse_switch(report, {})) << int{id} << " " << size;
        }
}

TEST(SwitchPro, WritesCommands) {
    EXPECT_EQ(switch_usb_command(SwitchUsb::handshake), bytes("80 02 ..62"));
    const uint8_t mode[] = {0x30};
    EXPECT_EQ(switch_command(SwitchCommand::set_report_mode, mode, 0x12),
              bytes("01 02 00 01 40 40 00 01 40 40 03 30 ..37"));
    EXPECT_EQ(flash_arguments(0x603d, 18), bytes("3d 60 00 00 12"));
}

TEST(SwitchPro, WritesRumble) {
    // The table's ends: nothing, and the strongest that is safe
    EXPECT_EQ(switch_rumble({}, 0), bytes("10 00 00 01 40 40 00 01 40 40"));
    EXPECT_EQ(switch_rumble({1.0f, 1.0f}, 1), bytes("10 01 00 c9 40 72 00 c9 40 72"));
    uint8_t before = 0;
    for (int i = 0; i <= 100; ++i) { // the stronger the call, the stronger the motor
        const auto report = switch_rumble({0.0f, static_cast<float>(i) / 100.0f}, 0);
        EXPECT_GE(report[3], before);
        EXPECT_LE(report[3], 0xc9);
        before = report[3];
    }
}

TEST(SwitchPro, UnderstandsAnswers) {
    EXPECT_EQ(confirmed_usb_command(bytes("81 02 ..62")), SwitchUsb::handshake);
    EXPECT_FALSE(confirmed_usb_command(bytes("81")));
    EXPECT_FALSE(confirmed_usb_command(bytes("30 02")));

    auto report = bytes("21 00 8e ..10 90 10 3d 60 00 00 12");
    report.resize(49);
    report[20] = 0x78;
    const auto answer = command_answer(report);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->command, SwitchCommand::read_flash);
    const auto flash = flash_content(*answer, factory_sticks_at, factory_sticks_size);
    ASSERT_TRUE(flash);
    EXPECT_EQ(flash->size(), 18u);
    EXPECT_EQ((*flash)[0], 0x78);
    EXPECT_FALSE(flash_content(*answer, user_sticks_at, user_sticks_size)) << "another address";
    report[13] = 0x00;
    EXPECT_FALSE(command_answer(report)) << "refused";
    EXPECT_FALSE(command_answer(Bytes(report).first(48)));
}

} // namespace
} // namespace host::pads::test
