// Conversations: what a driver sends, and what it makes of the answers.
#include <map>

#include <gtest/gtest.h>

#include "descriptors.h"
#include "pads/driver.h"
#include "pads/switch_pro.h"

namespace host::pads::test {
namespace {

using namespace std::chrono_literals;

struct FakeLink : Link {
    std::vector<std::vector<uint8_t>> written;
    std::map<uint8_t, std::vector<uint8_t>> features;
    std::vector<uint8_t> asked;

    bool write(Bytes report) override {
        written.emplace_back(report.begin(), report.end());
        return true;
    }
    std::vector<uint8_t> feature(uint8_t id, size_t) override {
        asked.push_back(id);
        return features[id];
    }
};

std::unique_ptr<Driver> driver_of(uint16_t vendor, uint16_t product, Bus bus,
                                  const std::vector<uint8_t>& descriptor = {}) {
    auto driver = make_driver({vendor, product, bus}, descriptor, "");
    EXPECT_TRUE(driver);
    return driver;
}

TEST(Drivers, SonysCalibrationSwitchesTheFullModeOn) {
    const struct {
        uint16_t product;
        Bus bus;
        std::vector<uint8_t> asked;
        uint8_t output;
    } cases[] = {{0x05c4, Bus::usb, {0x02}, 0x05},
                 {0x09cc, Bus::bluetooth, {0x05}, 0x11},
                 {0x0ba0, Bus::usb, {0x02}, 0x05},
                 {0x0ce6, Bus::usb, {0x05, 0x20}, 0x02},
                 {0x0ce6, Bus::bluetooth, {0x05, 0x20}, 0x31},
                 {0x0df2, Bus::usb, {0x05}, 0x02}};
    for (const auto& c : cases) {
        FakeLink link;
        const auto driver = driver_of(0x054c, c.product, c.bus);
        driver->start(link);
        EXPECT_EQ(link.asked, c.asked);
        ASSERT_EQ(link.written.size(), 1u);
        EXPECT_EQ(link.written[0][0], c.output);
        EXPECT_TRUE(driver->abilities().light);
        EXPECT_TRUE(driver->send(link, {1.0f, 1.0f}, {1, 2, 3}));
        EXPECT_EQ(link.written.size(), 2u);
    }
}

TEST(Drivers, DualSenseUsesTheVibrationOfItsFirmware) {
    for (const bool modern : {false, true}) {
        FakeLink link;
        link.features[0x20] = bytes("20 ..43 15 0" + std::string(modern ? "2" : "1") + " ..18");
        const auto driver = driver_of(0x054c, 0x0ce6, Bus::usb);
        driver->start(link);
        EXPECT_EQ(link.written[0][1], modern ? 0x02 : 0x03);
        EXPECT_EQ(link.written[0][39], modern ? 0x04 : 0x00);
    }
}

TEST(Drivers, DualSenseNumbersItsBluetoothReports) {
    FakeLink link;
    const auto driver = driver_of(0x054c, 0x0ce6, Bus::bluetooth);
    driver->start(link);
    for (int i = 0; i < 16; ++i) driver->send(link, {}, {});
    for (size_t i = 0; i < 17; ++i) EXPECT_EQ(link.written[i][1], (i % 16) << 4);
    EXPECT_EQ(link.written[0][44], 0x02) << "the light show ends at the start";
    EXPECT_EQ(link.written[1][44], 0x00) << "and only then";
}

std::vector<uint8_t> answer_to(const std::vector<uint8_t>& command) {
    if (command[0] == 0x80) {
        auto answer = bytes("81 00 ..62");
        answer[1] = command[1];
        return answer;
    }
    auto answer = bytes("21 00 8e 00 00 00 d0 07 7d d0 07 7d 00 80 00 ..34");
    answer[14] = command[10];
    if (command[10] == 0x10) {
        std::copy_n(command.begin() + 11, 5, answer.begin() + 15);
        if (command[11] == 0x3d) { // the factory's calibration
            const auto flash = bytes("78 45 51 d0 47 83 b0 c4 44 6c 87 89 e8 e3 47 dc a5 5a");
            std::copy(flash.begin(), flash.end(), answer.begin() + 20);
        }
    }
    return answer;
}

const std::vector<std::vector<uint8_t>> usb_greeting = {bytes("80 02 ..62"), bytes("80 03 ..62"),
                                                        bytes("80 02 ..62"), bytes("80 04 ..62")};

TEST(Drivers, SwitchProIsSetUpStepByStep) {
    for (const Bus bus : {Bus::usb, Bus::bluetooth}) {
        FakeLink link;
        const auto driver = driver_of(0x057e, 0x2009, bus);
        Time now{1s};
        driver->start(link);
        std::vector<uint8_t> commands;
        for (size_t done = 0; done < 40; ++done, now += 4ms) {
            driver->tick(link, now);
            if (link.written.size() > done) driver->receive(answer_to(link.written[done]), {});
        }
        size_t first = 0;
        if (bus == Bus::usb) {
            ASSERT_GT(link.written.size(), 4u);
            for (; first < 4; ++first) EXPECT_EQ(link.written[first], usb_greeting[first]);
        }
        for (size_t i = first; i < link.written.size(); ++i) {
            EXPECT_EQ(link.written[i][0], 0x01);
            EXPECT_EQ(link.written[i][1], i - first) << "numbered";
            commands.push_back(link.written[i][10]);
        }
        EXPECT_EQ(commands, bytes("10 10 03 40 48 30"));
        // 1000 x 2100 is fully left with the factory's calibration, 2000 to 1200 below
        auto report = bytes("30 00 8e 00 00 00 20 43 83 ..40");
        EXPECT_EQ(driver->receive(report, {})->left, (Stick{-1.0f, 0.0f}));
    }
}

TEST(Drivers, SwitchProThatDoesNotAnswerPlaysWithDefaults) {
    FakeLink link;
    const auto driver = driver_of(0x057e, 0x2009, Bus::usb);
    Time now{1s};
    for (int i = 0; i < 1000; ++i, now += 10ms) driver->tick(link, now);
    EXPECT_EQ(link.written.size(), 3 * 3 + 1 + 6 * 3u) << "three tries each, then silence";
    EXPECT_TRUE(driver->receive(bytes("30 ..48"), {}));
}

TEST(Drivers, SwitchProIsPutBackIntoItsFullModeButNotForever) {
    FakeLink link;
    const auto driver = driver_of(0x057e, 0x2009, Bus::bluetooth);
    Time now{1s};
    const auto simple = bytes("3f 00 00 08 00 80 00 80 00 80 00 80");
    size_t answered = 0;
    const auto talk = [&](int polls) {
        for (int i = 0; i < polls; ++i, now += 4ms) {
            driver->tick(link, now);
            while (answered < link.written.size())
                driver->receive(answer_to(link.written[answered++]), {});
        }
    };
    talk(20);
    const size_t before = link.written.size();
    driver->receive(simple, {});
    talk(20);
    ASSERT_GT(link.written.size(), before);
    EXPECT_EQ(link.written[before][10], 0x03);
    for (int i = 0; i < 100; ++i) {
        driver->receive(simple, {});
        talk(10);
    }
    EXPECT_LT(link.written.size(), before + 20);
}

TEST(Drivers, SwitchProsRumbleIsRenewedUntilItEnds) {
    FakeLink link;
    const auto driver = driver_of(0x057e, 0x2009, Bus::bluetooth);
    Time now{1s};
    for (int i = 0; i < 1000; ++i, now += 10ms) driver->tick(link, now);
    link.written.clear();
    driver->send(link, {1.0f, 0.0f}, {});
    for (int i = 0; i < 100; ++i, now += 10ms) driver->tick(link, now);
    EXPECT_EQ(link.written.size(), 1u + 25u);
    for (const auto& report : link.written) EXPECT_EQ(report[5], 0x72);
    link.written.clear();
    driver->send(link, {}, {});
    for (int i = 0; i < 100; ++i, now += 10ms) driver->tick(link, now);
    EXPECT_EQ(link.written.size(), 1u);
}

TEST(Drivers, EightBitDoRumblesOnlyIfItSaysSo) {
    FakeLink link;
    auto plain = driver_of(0x2dc8, 0x6001, Bus::usb, plain_descriptor());
    EXPECT_FALSE(plain->abilities().rumble);
    EXPECT_FALSE(plain->send(link, {1, 1}, {}));
    auto with_motors = numbered_descriptor();
    for (size_t i = 0; i + 1 < with_motors.size(); ++i)
        if (with_motors[i] == 0x85 && with_motors[i + 1] == 9) with_motors[i + 1] = 5;
    auto strong = driver_of(0x2dc8, 0x6001, Bus::usb, with_motors);
    EXPECT_TRUE(strong->send(link, {1, 1}, {}));
    EXPECT_EQ(link.written.back(), bytes("05 ff ff 00 00"));
}

TEST(Drivers, NoneForWhatIsNoPad) {
    EXPECT_FALSE(make_driver({0x1234, 1, Bus::usb}, mouse_descriptor(), ""));
    EXPECT_FALSE(make_driver({0x2dc8, 1, Bus::usb}, mouse_descriptor(), ""));
    EXPECT_FALSE(make_driver({0x1234, 1, Bus::usb}, {}, ""));
}

} // namespace
} // namespace host::pads::test
