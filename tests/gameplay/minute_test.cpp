// A minute of play, recorded and played again: the same bits on every instruction set, with any
// number of threads, from every compiler.
#include "support/small_game.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace peregrine::test {
namespace {

using gameplay::Replay;
using gameplay::Tick;

constexpr uint64_t kSeed = 1;
constexpr uint64_t kLastHash = 9248646437850458766u; // of the whole minute, on every machine

Replay record(SmallGame& game) {
    Replay replay;
    replay.ticks_per_second = SmallGame::kTicksPerSecond;
    replay.seed = kSeed;
    for (const gameplay::TickInput& input : minute_of_inputs(kSeed))
        replay.ticks.push_back({input, game.play_tick(input)});
    return replay;
}

TEST(MinuteOfPlay, HasTheSameBitsEverywhere) {
    SmallGame game(RT_ISA_BEST, 1);
    const Replay recorded = record(game);
    const SmallGame::Events& events = game.events();
    std::printf(
        "%zu grenades, %zu bounces, %zu came to rest; %zu jumps; %zu ticks on the lift, %zu "
        "of alarm\n",
        events.thrown, events.bounces, events.rested, events.jumps, events.rides, events.alarms);
    EXPECT_EQ(events.thrown, 80u);
    EXPECT_GT(events.bounces, 200u);
    EXPECT_GT(events.rested, 40u);
    EXPECT_GT(events.jumps, 20u);
    EXPECT_GT(events.rides, 60u);
    EXPECT_GT(events.alarms, 60u);
    EXPECT_EQ(recorded.ticks.back().hash, kLastHash);

    const Replay replay = gameplay::decode_replay(gameplay::encode_replay(recorded));
    for (const rt_isa isa : {RT_ISA_SCALAR, RT_ISA_SSE4, RT_ISA_AVX2, RT_ISA_AVX512, RT_ISA_BEST})
        for (const uint32_t threads : {1u, 2u}) {
            SmallGame again(isa, threads);
            if (!again.is_supported()) continue;
            const size_t astray = gameplay::play(
                replay, [&](const gameplay::TickInput& input) { return again.play_tick(input); });
            EXPECT_EQ(astray, replay.ticks.size()) << "isa " << isa << ", threads " << threads;
        }
}

// One wrong input, and the replay says from which tick on.
TEST(MinuteOfPlay, TellsWhereItWentAstray) {
    SmallGame game(RT_ISA_BEST, 1), again(RT_ISA_BEST, 1);
    Replay replay = record(game);
    replay.ticks.resize(600);
    replay.ticks[345].input.walk[0] -= 1;
    EXPECT_EQ(gameplay::play(replay, [&](const auto& input) { return again.play_tick(input); }),
              345u);
}

} // namespace
} // namespace peregrine::test
