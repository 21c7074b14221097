// Three Cores played by nobody who knows it: random input, for long, on every level. Ten sessions
// of ten minutes each: PEREGRINE_SESSIONS=10 PEREGRINE_SESSION_MINUTES=10 gameplay.sessions
#include "game/arena.h"
#include "game/round.h"
#include "gameplay/random.h"
#include "support/world.h"

#include <gtest/gtest.h>

#include <malloc.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace peregrine::test {
namespace {

using gameplay::TickInput;
using gameplay::Vec3;

uint32_t number(const char* variable, uint32_t otherwise) {
    const char* text = std::getenv(variable);
    return text ? uint32_t(std::strtoul(text, nullptr, 10)) : otherwise;
}

// Somebody who tries everything, each for a while.
class Fidget {
public:
    explicit Fidget(uint64_t seed) : random_(seed) {}

    TickInput next(uint64_t tick) {
        if (tick % 40 == 0) {
            const Vec3 way = random_.in_ball();
            input_.walk[0] = float(way.x);
            input_.walk[1] = float(way.z);
        }
        if (tick % 30 == 0) {
            const Vec3 view = glm::normalize(random_.in_ball() + Vec3(1e-9, 0, 0));
            for (int k = 0; k < 3; ++k) input_.view[k] = float(view[k]);
        }
        if (tick % 20 == 0) input_.buttons = random_.below(three_cores::kButtons + 1);
        return input_;
    }

private:
    gameplay::Random random_;
    TickInput input_;
};

struct Tally {
    uint32_t rounds = 0, lost = 0, won = 0;
    double light = 0;
};

void expect_inside(const three_cores::Plan& plan, const three_cores::Game& game) {
    const Vec3& at = game.player().state().position;
    const double margin = 25; // of a fall over the edge
    for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(std::isfinite(at[k]));
        ASSERT_GE(at[k], plan.lower[k] - margin);
        ASSERT_LE(at[k], plan.upper[k] + margin);
    }
}

Tally play_session(host::game::Arena& arena, uint64_t seed, uint64_t ticks) {
    Tally tally;
    Fidget fidget(seed);
    host::game::RoundSetup setup;
    setup.commit = arena.commit();
    std::optional<host::game::Round> round;
    for (uint64_t tick = 0; tick < ticks; ++tick) {
        if (!round || round->over()) {
            setup.seed = {three_cores::Difficulty(tally.rounds % 3), seed + tally.rounds};
            round.emplace(arena.stage(), arena.plan(), setup);
            ++tally.rounds;
        }
        round->tick(fidget.next(tick));
        const three_cores::Status& status = round->game().status();
        if (round->over()) {
            tally.won += status.outcome == three_cores::Outcome::won;
            tally.lost += status.outcome == three_cores::Outcome::lost;
        }
        tally.light += status.light / double(ticks);
        expect_inside(arena.plan(), round->game());
        if (testing::Test::HasFatalFailure()) return tally;
    }
    return tally;
}

void play_sessions(const std::string& path) {
    SCOPED_TRACE(path);
    host::Options options;
    options.scene = path;
    options.library = ENGINE;
    options.quiet = true;
    host::game::Arena arena(options, [](const char*, float) {});
    const uint32_t sessions = number("PEREGRINE_SESSIONS", 1);
    const uint64_t ticks = 60 * 60 * uint64_t(number("PEREGRINE_SESSION_MINUTES", 1));
    size_t before = 0;
    for (uint32_t session = 0; session < sessions; ++session) {
        const Tally tally = play_session(arena, 100 * session + 1, ticks);
        if (testing::Test::HasFatalFailure()) return;
        const size_t bytes = mallinfo2().uordblks;
        std::printf("%s: %u rounds, %u lost, %u won; mean light %.2f; %zu kB\n",
                    path.substr(path.rfind('/') + 1).c_str(), tally.rounds, tally.lost, tally.won,
                    tally.light, bytes / 1024);
        // What a session leaves behind: nothing, but for what the first one filled.
        if (session == 0) before = bytes;
        EXPECT_LT(bytes, before + (size_t{1} << 20));
    }
}

TEST(Sessions, OnTheLevelsOfTheProject) {
    for (const char* name : {"hall", "mill"})
        play_sessions(std::string(PEREGRINE_SOURCE_DIR) + "/content/" + name + ".glb");
}

TEST(Sessions, OnTheLevelsOfOthers) {
    if (scene_names().empty()) GTEST_SKIP() << "no scenes: see PEREGRINE_SCENES";
    for (const std::string& name : scene_names())
        play_sessions(scenes_folder() + "/" + name + ".glb");
}

} // namespace
} // namespace peregrine::test
