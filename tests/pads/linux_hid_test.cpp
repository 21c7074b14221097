// A made-up sysfs. The real one is seen by tests/pads/qemu.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pads/linux_hid.h"

namespace host::pads::test {
namespace {

class LinuxHidTest : public testing::Test {
protected:
    void SetUp() override {
        std::string name = testing::TempDir() + "peregrine_pads_XXXXXX";
        ASSERT_TRUE(mkdtemp(name.data()));
        root = name;
    }
    void TearDown() override { std::filesystem::remove_all(root); }

    void add(const std::string& name, const std::string& uevent, const std::string& descriptor) {
        const auto device = root / name / "device";
        std::filesystem::create_directories(device);
        std::ofstream(device / "uevent") << uevent;
        std::ofstream(device / "report_descriptor", std::ios::binary) << descriptor;
    }

    std::filesystem::path root;
};

TEST_F(LinuxHidTest, ListsNodesInOrderOfTheirNumbers) {
    for (const char* name : {"hidraw10", "hidraw9", "hidraw", "hidrawx", "js0", "hidraw2"})
        add(name, "", "");
    LinuxHid hid(root);
    EXPECT_EQ(hid.names(), (std::vector<std::string>{"hidraw2", "hidraw9", "hidraw10"}));
    EXPECT_TRUE(LinuxHid(root / "missing").names().empty());
}

TEST_F(LinuxHidTest, ReadsWhatTheKernelTells) {
    add("hidraw0",
        "DRIVER=playstation\nHID_ID=0005:0000054C:00000CE6\nHID_NAME=DualSense = Pad\n"
        "HID_PHYS=aa:bb\nHID_UNIQ=cc:dd\nMODALIAS=hid:b0005\n",
        std::string("\x05\x01\x00\x0a", 4));
    add("hidraw1", "HID_ID=nonsense\n", "");
    LinuxHid hid(root, "/nowhere");
    HidNode node;
    ASSERT_TRUE(hid.describe("hidraw0", node));
    EXPECT_EQ(node.path, "/nowhere/hidraw0");
    EXPECT_EQ(node.identity.vendor, 0x054c);
    EXPECT_EQ(node.identity.product, 0x0ce6);
    EXPECT_EQ(node.identity.bus, Bus::bluetooth);
    EXPECT_EQ(node.product, "DualSense = Pad");
    EXPECT_EQ(node.serial, "cc:dd");
    EXPECT_EQ(node.descriptor, (std::vector<uint8_t>{5, 1, 0, 10}));
    EXPECT_FALSE(hid.describe("hidraw1", node));
    EXPECT_FALSE(hid.describe("hidraw7", node));
}

TEST_F(LinuxHidTest, TellsDeniedFromMissing) {
    LinuxHid hid(root, root);
    HidNode node;
    node.path = root / "hidraw0";
    EXPECT_FALSE(hid.open(node).port);
    EXPECT_FALSE(hid.open(node).denied) << "there is none";
    std::ofstream(root / "hidraw0") << "";
    std::filesystem::permissions(root, std::filesystem::perms::all);
    EXPECT_FALSE(hid.open(node).port) << "a file is no device";
    chmod(node.path.c_str(), 0);
    const auto denied = [&] { // as anybody but root, who may open everything
        if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
        _exit(hid.open(node).denied ? 0 : 1);
    };
    EXPECT_EXIT(denied(), testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace host::pads::test
