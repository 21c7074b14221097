// The udev rules name every pad that the program knows by its numbers.
#include <cstdio>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "pads/known_pads.h"

namespace host::pads::test {
namespace {

TEST(UdevRules, NameEveryKnownPad) {
    std::ifstream file(PEREGRINE_PAD_RULES);
    const std::string rules(std::istreambuf_iterator<char>(file), {});
    ASSERT_FALSE(rules.empty());
    int known = 0;
    for (const uint16_t vendor :
         {uint16_t{0x054c}, uint16_t{0x057e}, uint16_t{0x045e}, uint16_t{0x0079}, uint16_t{0x0810}})
        for (unsigned product = 0; product <= 0xffff; ++product) {
            const Identity identity{vendor, static_cast<uint16_t>(product), Bus::bluetooth};
            if (family_of(identity) == Family::generic && known_mapping(identity).empty()) continue;
            ++known;
            char pattern[16];
            std::snprintf(pattern, sizeof pattern, ":%04X:%04X.*", vendor, product);
            EXPECT_NE(rules.find(pattern), std::string::npos) << pattern;
        }
    EXPECT_EQ(known, 17);
    EXPECT_NE(rules.find("*:2DC8:*"), std::string::npos);
}

} // namespace
} // namespace host::pads::test
