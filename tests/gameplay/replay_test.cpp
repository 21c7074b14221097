#include "gameplay/fixed_step.h"
#include "gameplay/random.h"
#include "gameplay/replay.h"
#include "gameplay/state_hash.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

namespace peregrine::test {
namespace {

using namespace gameplay;

Replay some_replay(size_t ticks) {
    Replay replay;
    replay.ticks_per_second = 120;
    replay.seed = 7;
    replay.level = 0xfedcba9876543210u;
    Random random(replay.seed);
    for (size_t i = 0; i < ticks; ++i) {
        Tick tick;
        for (float& x : tick.input.walk) x = float(random.between(-1, 1));
        for (float& x : tick.input.view) x = float(random.between(-1, 1));
        tick.input.buttons = uint32_t(random.next());
        tick.hash = random.next();
        replay.ticks.push_back(tick);
    }
    return replay;
}

std::string refusal(const std::vector<uint8_t>& bytes) {
    try {
        decode_replay(bytes);
    } catch (const ReplayError& error) {
        return error.what();
    }
    return "taken";
}

void expect_refusal(const std::vector<uint8_t>& bytes, const char* part) {
    EXPECT_NE(refusal(bytes).find(part), std::string::npos) << refusal(bytes);
}

TEST(Replay, ComesBackFromItsFile) {
    const std::string path = testing::TempDir() + "/peregrine_replay_test";
    for (const size_t ticks : {0u, 1u, 1000u}) {
        const Replay replay = some_replay(ticks);
        EXPECT_EQ(decode_replay(encode_replay(replay)), replay);
        save_replay(replay, path);
        EXPECT_EQ(load_replay(path), replay);
    }
    std::remove(path.c_str());
    EXPECT_THROW(load_replay(path), ReplayError);
    EXPECT_THROW(save_replay({}, testing::TempDir() + "/no such folder/x"), ReplayError);
}

// The bytes are the file's, on every machine.
TEST(Replay, HasThisLayout) {
    Replay replay;
    replay.seed = 1;
    replay.level = 2;
    replay.ticks.push_back({{{0.5f, 0}, {0, 0, -1}, 3}, 0x0102030405060708u});
    const std::vector<uint8_t> bytes = encode_replay(replay);
    const std::vector<uint8_t> begin = {
        'P', 'R', 'G', 'N', 'R', 'P', 'L', 'Y', 1, 0, 0, 0, 60, 0, 0, 0, 1, 0, 0, 0, 0, 0,
        0,   0,   2,   0,   0,   0,   0,   0,   0, 0, 1, 0, 0,  0, 0, 0, 0, 0, 0, 0, 0, 0x3f};
    ASSERT_EQ(bytes.size(), 40u + 32 + 8);
    EXPECT_EQ(std::vector<uint8_t>(bytes.begin(), bytes.begin() + 44), begin);
    EXPECT_EQ(bytes[60], 3);
    EXPECT_EQ(bytes[64], 8);
    EXPECT_EQ(bytes[71], 1);
}

TEST(Replay, RefusesBrokenFilesWithASentence) {
    const std::vector<uint8_t> good = encode_replay(some_replay(5));
    const auto with = [&](size_t place, uint8_t value) {
        std::vector<uint8_t> bytes = good;
        bytes[place] = value;
        return bytes;
    };
    expect_refusal({}, "no replay");
    expect_refusal(with(0, 'p'), "no replay");
    expect_refusal(with(8, 2), "version 2");
    expect_refusal(with(39, 0x7f), "there is room for 5");
    expect_refusal(with(50, uint8_t(good[50] ^ 1)), "damaged");
    expect_refusal(with(good.size() - 1, uint8_t(good.back() ^ 0x80)), "damaged");
    for (size_t size = 0; size < good.size(); ++size)
        EXPECT_NE(refusal({good.begin(), good.begin() + long(size)}), "taken") << size;
    std::vector<uint8_t> longer = good;
    longer.push_back(0);
    EXPECT_NE(refusal(longer), "taken");
}

// Every single wrong byte is found.
TEST(Replay, TakesNoChangedByte) {
    std::vector<uint8_t> bytes = encode_replay(some_replay(3));
    for (uint8_t& byte : bytes) {
        byte ^= 0x10;
        EXPECT_NE(refusal(bytes), "taken") << &byte - bytes.data();
        byte ^= 0x10;
    }
    EXPECT_EQ(refusal(bytes), "taken");
}

TEST(Replay, RefusesInputsThatAreNoNumbers) {
    Replay replay = some_replay(5);
    replay.ticks[3].input.view[1] = std::numeric_limits<float>::quiet_NaN();
    expect_refusal(encode_replay(replay), "tick 3 is not finite");
    replay.ticks_per_second = 0;
    EXPECT_THROW(encode_replay(replay), ReplayError);
}

TEST(Replay, FindsWhereAGameGoesAstray) {
    Replay replay = some_replay(100);
    const auto game = [](uint64_t seed) {
        return [state = StateHash(), random = Random(seed)](const TickInput& input) mutable {
            state.add(double(input.walk[0]) + random.uniform());
            return state.value();
        };
    };
    auto record = game(1);
    for (Tick& tick : replay.ticks) tick.hash = record(tick.input);
    EXPECT_EQ(play(replay, game(1)), 100u);
    EXPECT_EQ(play(replay, game(2)), 0u);
    replay.ticks[42].input.walk[0] += 1e-6f;
    EXPECT_EQ(play(replay, game(1)), 42u);
}

TEST(StateHash, TellsNumbersApartButNotTheirZeros) {
    const auto hash = [](double x) {
        StateHash state;
        state.add(x);
        return state.value();
    };
    EXPECT_EQ(hash(0.0), hash(-0.0));
    EXPECT_EQ(hash(std::numeric_limits<double>::quiet_NaN()),
              hash(-std::numeric_limits<double>::signaling_NaN()));
    EXPECT_NE(hash(1), hash(1 + 1e-15));
    EXPECT_NE(hash(1), hash(-1));
    StateHash ab, ba;
    ab.add(1.0), ab.add(2.0);
    ba.add(2.0), ba.add(1.0);
    EXPECT_NE(ab.value(), ba.value());
}

// The first numbers of seed 0 in the published reference code.
TEST(Random, IsSplitMix64) {
    Random random(0);
    EXPECT_EQ(random.next(), 0xe220a8397b1dcdafu);
    EXPECT_EQ(random.next(), 0x6e789e6aa1b965f4u);
    EXPECT_EQ(random.next(), 0x06c45d188009454fu);
    Random same(0);
    same.next();
    EXPECT_EQ(Random(same.state()).next(), 0x6e789e6aa1b965f4u);
}

TEST(Random, IsEven) {
    Random random(5);
    double sum = 0;
    int counts[7] = {};
    for (int i = 0; i < 70000; ++i) {
        const double x = random.uniform();
        ASSERT_GE(x, 0);
        ASSERT_LT(x, 1);
        sum += x;
        ++counts[random.below(7)];
    }
    EXPECT_NEAR(sum / 70000, 0.5, 0.005);
    for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
}

TEST(FixedStep, MakesTheTicksOfTheTimeThatPassed) {
    FixedStep clock(60);
    Random random(6);
    double passed = 0;
    uint64_t ticks = 0;
    for (int i = 0; i < 10000; ++i) {
        const double frame = random.between(0, 0.05);
        passed += frame;
        ticks += clock.advance(frame);
        ASSERT_NEAR(double(ticks) + clock.blend(), passed * 60, 1e-6);
        ASSERT_GE(clock.blend(), 0);
        ASSERT_LT(clock.blend(), 1);
    }
    EXPECT_EQ(clock.time(120), 2);
}

TEST(FixedStep, FallsBehindInsteadOfChokingOnALongFrame) {
    FixedStep clock(60, 5);
    EXPECT_EQ(clock.advance(100), 5u);
    EXPECT_LE(clock.blend(), 1);
    EXPECT_LE(clock.advance(0), 1u);
}

} // namespace
} // namespace peregrine::test
