#include <gtest/gtest.h>

#include "fake_hid.h"
#include "pads/listing.h"
#include "pads/manager.h"

namespace host::pads::test {
namespace {

using namespace std::chrono_literals;
using Kind = PadEvent::Kind;

constexpr Identity dualsense{0x054c, 0x0ce6, Bus::usb}, plain{0x1234, 0x0001, Bus::usb};

std::vector<uint8_t> cross_down() {
    auto report = bytes("01 80 80 80 80 00 00 00 28");
    report.resize(64);
    return report;
}

std::vector<uint8_t> nothing_down() {
    auto report = bytes("01 80 80 80 80 00 00 00 08");
    report.resize(64);
    return report;
}

class PadManagerTest : public testing::Test {
protected:
    std::vector<PadEvent> poll(std::chrono::milliseconds later = 600ms) {
        now += later;
        return manager.poll(now);
    }

    FakeHid hid;
    PadManager manager{hid};
    Time now{1s};
};

TEST_F(PadManagerTest, SeesAPadComeAndGo) {
    EXPECT_TRUE(poll().empty());
    const auto device = hid.plug_in("hidraw0", dualsense);
    auto events = poll();
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, Kind::connected);
    EXPECT_EQ(events[0].text, "Pad of hidraw0 is connected");
    const Pad* pad = manager.find(events[0].id);
    ASSERT_TRUE(pad);
    EXPECT_EQ(pad->family, Family::dualsense);
    EXPECT_STREQ(pad->prompts.name(Button::south), "Cross");
    EXPECT_EQ(manager.active(), nullptr) << "nobody touched it";

    device->reports = {nothing_down(), cross_down()};
    EXPECT_TRUE(poll(16ms).empty());
    EXPECT_EQ(pad->state.buttons, buttons(Button::south));
    EXPECT_EQ(pad->pressed, buttons(Button::south));
    EXPECT_EQ(manager.active(), pad);

    const PadId id = pad->id;
    hid.pull_out("hidraw0");
    events = poll(16ms);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, Kind::disconnected);
    EXPECT_TRUE(events[0].was_active) << "so that the game pauses";
    EXPECT_EQ(manager.find(id), nullptr);
    EXPECT_EQ(manager.active(), nullptr);
    EXPECT_TRUE(poll().empty());
}

TEST_F(PadManagerTest, SeesAShortPressBetweenTwoFrames) {
    const auto device = hid.plug_in("hidraw0", dualsense);
    poll();
    device->reports = {nothing_down(), cross_down(), nothing_down()};
    poll(16ms);
    const Pad* pad = manager.pads().at(0);
    EXPECT_EQ(pad->pressed, buttons(Button::south));
    EXPECT_EQ(pad->released, buttons(Button::south));
    EXPECT_FALSE(pad->state.buttons.any());
    poll(16ms);
    EXPECT_FALSE(pad->pressed.any());
}

TEST_F(PadManagerTest, IgnoresGarbage) {
    const auto device = hid.plug_in("hidraw0", dualsense);
    poll();
    device->reports = {cross_down(), bytes("01 02 03"), std::vector<uint8_t>(500, 0xff)};
    EXPECT_TRUE(poll(16ms).empty());
    EXPECT_EQ(manager.pads().at(0)->state.buttons, buttons(Button::south));
}

TEST_F(PadManagerTest, TheSameNameMayComeBackAsAnotherDevice) {
    hid.plug_in("hidraw0", dualsense);
    const PadId first = poll().at(0).id;
    hid.pull_out("hidraw0");
    hid.plug_in("hidraw0", plain, plain_descriptor());
    const auto events = poll();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].kind, Kind::disconnected);
    EXPECT_EQ(events[0].id, first);
    EXPECT_EQ(events[1].kind, Kind::connected);
    EXPECT_NE(events[1].id, first);
    EXPECT_EQ(manager.pads().at(0)->family, Family::generic);
}

TEST_F(PadManagerTest, LeavesOtherDevicesAlone) {
    const auto mouse = hid.plug_in("hidraw0", plain, mouse_descriptor());
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(poll().empty());
    EXPECT_EQ(mouse->opened, 0);
}

TEST_F(PadManagerTest, WaitsForADescriptorThatIsNotThereYet) {
    const auto device = hid.plug_in("hidraw0", plain);
    EXPECT_TRUE(poll().empty());
    device->node.descriptor = plain_descriptor();
    EXPECT_EQ(poll().size(), 1u);
}

TEST_F(PadManagerTest, LooksForPadsTwiceASecondOnly) {
    for (int i = 0; i < 100; ++i) poll(10ms);
    EXPECT_LE(hid.scans, 3);
    EXPECT_GE(hid.scans, 2);
}

TEST_F(PadManagerTest, WithoutPermissionNamesTheRuleOnceAndKeepsTrying) {
    const auto device = hid.plug_in("hidraw3", plain, plain_descriptor());
    device->denied = true;
    std::vector<PadEvent> events;
    for (int i = 0; i < 20; ++i)
        for (const PadEvent& event : poll()) {
            EXPECT_GE(i, 3) << "udev may still be at work";
            events.push_back(event);
        }
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, Kind::refused);
    for (const char* part : {"/dev/hidraw3", "70-peregrine-pads.rules", "*:1234:0001.*", "uaccess"})
        EXPECT_NE(events[0].text.find(part), std::string::npos) << part;
    device->denied = false;
    events = poll();
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, Kind::connected);
}

TEST_F(PadManagerTest, OnePadByCableAndRadioIsOnePad) {
    hid.plug_in("hidraw0", dualsense, {}, "aa:bb");
    hid.plug_in("hidraw1", {0x054c, 0x0ce6, Bus::bluetooth}, {}, "aa:bb");
    hid.plug_in("hidraw2", {0x054c, 0x0ce6, Bus::bluetooth}, {}, "cc:dd");
    EXPECT_EQ(poll().size(), 2u);
    hid.pull_out("hidraw0");
    const auto events = poll();
    ASSERT_EQ(events.size(), 2u) << "the radio takes over";
    EXPECT_EQ(events[1].kind, Kind::connected);
    EXPECT_EQ(manager.find(events[1].id)->path, "/dev/hidraw1");
}

TEST_F(PadManagerTest, TwoPadsWithTheSameBadSerialNumberAreTwo) {
    hid.plug_in("hidraw0", plain, plain_descriptor(), "0001");
    hid.plug_in("hidraw1", plain, plain_descriptor(), "0001");
    EXPECT_EQ(poll().size(), 2u);
}

TEST_F(PadManagerTest, PromptsFollowThePadInUse) {
    const auto sony = hid.plug_in("hidraw0", dualsense);
    const auto other = hid.plug_in("hidraw1", {0x2dc8, 0x6001, Bus::usb}, plain_descriptor());
    poll();
    sony->reports = {cross_down()};
    poll(16ms);
    EXPECT_EQ(manager.active()->prompts.style(), PromptStyle::dualsense);
    other->reports = {bytes("ff 80 80 80 08 00 00 00")}; // a stick, no button
    poll(16ms);
    EXPECT_EQ(manager.active()->prompts.style(), PromptStyle::nintendo);
}

TEST_F(PadManagerTest, RumblesForAsLongAsAsked) {
    const auto device = hid.plug_in("hidraw0", dualsense);
    const PadId id = poll().at(0).id;
    device->written.clear();
    EXPECT_TRUE(manager.rumble(id, {1.0f, 0.0f}, 0.1));
    for (int i = 0; i < 20; ++i) poll(10ms);
    ASSERT_EQ(device->written.size(), 2u);
    EXPECT_EQ(device->written[0][4], 255);
    EXPECT_EQ(device->written[1][4], 0);
    EXPECT_FALSE(manager.rumble(id + 1, {1.0f, 0.0f}, 1.0));
}

TEST_F(PadManagerTest, LightIsKeptWhileTheMotorsRun) {
    const auto device = hid.plug_in("hidraw0", dualsense);
    const PadId id = poll().at(0).id;
    device->written.clear();
    EXPECT_TRUE(manager.light(id, {10, 20, 30}));
    EXPECT_TRUE(manager.rumble(id, {0.0f, 1.0f}, 5.0));
    poll(10ms);
    ASSERT_EQ(device->written.size(), 1u) << "together";
    EXPECT_EQ(device->written[0][45], 10);
    EXPECT_EQ(device->written[0][3], 255);
}

TEST_F(PadManagerTest, SendsNoMoreThanTheRadioCarries) {
    const auto device = hid.plug_in("hidraw0", dualsense);
    const PadId id = poll().at(0).id;
    device->written.clear();
    for (int i = 0; i < 1000; ++i) {
        manager.rumble(id, {static_cast<float>(i % 2), 0.0f}, 1.0);
        poll(1ms);
    }
    EXPECT_LE(device->written.size(), 101u);
    EXPECT_GE(device->written.size(), 99u);
}

TEST(PadManager, StopsTheMotorsAtItsEnd) {
    FakeHid hid;
    const auto device = hid.plug_in("hidraw0", dualsense);
    {
        PadManager manager(hid);
        const PadId id = manager.poll(Time{1s}).at(0).id;
        manager.rumble(id, {1.0f, 1.0f}, 60.0);
        manager.poll(Time{2s});
        EXPECT_EQ(device->written.back()[4], 255);
    }
    EXPECT_EQ(device->written.back()[4], 0);
}

TEST(PadManager, PadsWithoutMotorsSaySo) {
    FakeHid hid;
    hid.plug_in("hidraw0", plain, plain_descriptor());
    PadManager manager(hid, {{{0x1234, 0x0001}, "south=3"}});
    const PadId id = manager.poll(Time{1s}).at(0).id;
    EXPECT_FALSE(manager.rumble(id, {1.0f, 1.0f}, 1.0));
    EXPECT_FALSE(manager.light(id, {1, 1, 1}));
}

TEST(PadList, TellsWhatIsThere) {
    FakeHid hid;
    EXPECT_EQ(list_pads(hid), "no gamepad is connected\n");
    hid.plug_in("hidraw0", dualsense);
    hid.plug_in("hidraw1", plain, plain_descriptor())->denied = true;
    hid.plug_in("hidraw2", plain, mouse_descriptor());
    const std::string text = list_pads(hid, {{{0x1234, 0x0001}, "south=7 west=none"}});
    for (const char* part :
         {"/dev/hidraw0  Pad of hidraw0, 054c:0ce6, USB", "DualSense; rumble, light, gyroscope",
          "Cross, Circle", "generic; no rumble", "mapping: south=2",
          "no permission to open /dev/hidraw1"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    EXPECT_EQ(text.find("hidraw2"), std::string::npos);
}

} // namespace
} // namespace host::pads::test
