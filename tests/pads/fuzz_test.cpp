// Anything may come from a cable. Sequences depend on the seed alone; PEREGRINE_PAD_FUZZ multiplies
// their length.
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "descriptors.h"
#include "pads/crc32.h"
#include "pads/driver.h"
#include "pads/dualsense.h"
#include "pads/dualshock4.h"
#include "pads/generic.h"
#include "pads/switch_commands.h"
#include "pads/switch_pro.h"
#include "pads/xbox.h"

namespace host::pads::test {
namespace {

int rounds(int few) {
    const char* factor = std::getenv("PEREGRINE_PAD_FUZZ");
    return few * (factor ? std::max(1, std::atoi(factor)) : 1);
}

class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}

    size_t below(size_t limit) { return engine_() % limit; }
    uint8_t byte() { return static_cast<uint8_t>(engine_()); }

    std::vector<uint8_t> bytes(size_t size) {
        std::vector<uint8_t> result(size);
        for (uint8_t& b : result) b = byte();
        return result;
    }

    // With an id and a size that some parser waits for, more often than not.
    std::vector<uint8_t> report() {
        static constexpr size_t sizes[] = {2, 8, 10, 12, 16, 17, 49, 64, 78};
        static constexpr uint8_t ids[] = {0x01, 0x02, 0x11, 0x21, 0x30, 0x31, 0x3f, 0x81};
        auto result = bytes(below(4) == 0 ? below(600) : sizes[below(std::size(sizes))]);
        if (!result.empty() && below(8) != 0) result[0] = ids[below(std::size(ids))];
        if (result.size() == 78 && below(2) == 0) {
            const uint32_t crc = crc32(bluetooth_input, Bytes(result).first(74));
            for (size_t i = 0; i < 4; ++i) result[74 + i] = static_cast<uint8_t>(crc >> 8 * i);
        }
        return result;
    }

private:
    std::mt19937 engine_;
};

void expect_in_range(const PadState& state) {
    for (const float axis : {state.left.x, state.left.y, state.right.x, state.right.y}) {
        EXPECT_GE(axis, -1.0f);
        EXPECT_LE(axis, 1.0f);
    }
    for (const float trigger : {state.left_trigger, state.right_trigger}) {
        EXPECT_GE(trigger, 0.0f);
        EXPECT_LE(trigger, 1.0f);
    }
}

// A copy of its own, so that the address sanitizer sees every byte beyond the end.
template <class F>
int count_states(Random& random, int reports, F parse) {
    int states = 0;
    PadState before;
    for (int i = 0; i < reports; ++i) {
        const auto report = random.report();
        const auto state = parse(Bytes(report), before);
        if (!state) continue;
        expect_in_range(*state);
        before = *state;
        ++states;
    }
    return states;
}

TEST(PadFuzz, EveryParserStaysInRange) {
    Random random(1);
    const int n = rounds(20000);
    const auto count = [&](auto parse) { return count_states(random, n, parse); };
    EXPECT_GT(count([](Bytes r, const PadState&) { return parse_dualshock4(r, {}); }), n / 200);
    EXPECT_GT(count([](Bytes r, const PadState&) { return parse_dualsense(r, {}); }), n / 200);
    EXPECT_GT(count([](Bytes r, const PadState&) { return parse_switch(r, {}); }), n / 200);
    for (const auto layout : {XboxLayout::one_s_early, XboxLayout::one_s, XboxLayout::series})
        EXPECT_GT(count([&](Bytes r, const PadState& b) { return parse_xbox(r, layout, b); }),
                  n / 200);
}

TEST(PadFuzz, AnswersAndFlash) {
    Random random(2);
    SwitchSticks sticks;
    for (int i = 0; i < rounds(20000); ++i) {
        auto report = random.report();
        if (report.size() > 14 && random.below(2) == 0) report[14] = 0x10;
        confirmed_usb_command(report);
        if (const auto answer = command_answer(report))
            flash_content(*answer, factory_sticks_at, random.byte());
        const auto flash = random.bytes(random.below(24));
        sticks = with_user_sticks(with_factory_sticks(sticks, flash), flash);
        const auto packet = random.bytes(49);
        if (const auto state = parse_switch(packet, sticks)) expect_in_range(*state);
        parse_sony_calibration(random.bytes(random.below(48)), GyroOrder::by_axis);
        parse_sony_calibration(random.bytes(random.below(48)), GyroOrder::by_sign);
        has_new_vibration(random.bytes(random.below(64)));
    }
}

// Bytes changed, cut out, doubled and strewn in.
void damage(std::vector<uint8_t>& descriptor, Random& random) {
    for (size_t i = random.below(6) + 1; i > 0 && !descriptor.empty(); --i) {
        const auto at =
            descriptor.begin() + static_cast<std::ptrdiff_t>(random.below(descriptor.size()));
        switch (random.below(4)) {
        case 0:
            *at = random.byte();
            break;
        case 1:
            descriptor.erase(at);
            break;
        case 2:
            descriptor.insert(at, random.byte());
            break;
        default: {
            const std::vector<uint8_t> copy(at, descriptor.end());
            if (descriptor.size() < 3000)
                descriptor.insert(descriptor.end(), copy.begin(), copy.end());
        }
        }
    }
}

TEST(PadFuzz, DamagedDescriptors) {
    Random random(3);
    const std::vector<uint8_t> seeds[] = {plain_descriptor(), numbered_descriptor(),
                                          array_descriptor(), mouse_descriptor()};
    int understood = 0;
    const int n = rounds(6000);
    for (int i = 0; i < n; ++i) {
        auto descriptor = seeds[random.below(std::size(seeds))];
        damage(descriptor, random);
        const auto parsed = parse_descriptor(descriptor);
        if (!parsed) continue;
        ++understood;
        const GenericReader reader(*parsed, default_mapping(*parsed, ButtonOrder::guess));
        PadState before;
        for (int k = 0; k < 8; ++k) {
            const auto report = random.bytes(random.below(80));
            if (const auto state = reader.parse(report, before)) {
                expect_in_range(*state);
                before = *state;
            }
        }
    }
    EXPECT_GT(understood, n / 10);
}

TEST(PadFuzz, RandomDescriptors) {
    Random random(4);
    for (int i = 0; i < rounds(4000); ++i) {
        const Identity identity{static_cast<uint16_t>(random.below(2) ? 0x2dc8 : 0x1234), 1,
                                Bus::usb};
        auto descriptor = random.bytes(random.below(400));
        if (auto driver = make_driver(identity, descriptor, ""))
            driver->receive(random.report(), {});
    }
}

} // namespace
} // namespace host::pads::test
