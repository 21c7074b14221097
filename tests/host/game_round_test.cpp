#include <gtest/gtest.h>

#include "animation/player.h"
#include "game/actors.h"
#include "game/live_round.h"
#include "game/node_names.h"
#include "game/plan_from_level.h"
#include "gltf/import.h"
#include "gltf_builder.h"
#include "plugin.h"

// Rounds of the game on the engine itself, in the smallest level that can be won:
//
//   spawn (0, 0)   core (0, -4)   exit (0, -8)   and a drone far away at (18, 18); seen from above,
//   x to the right and z down, on a floor from -20 to 20
namespace host::test {
namespace {

using game::Hands;
using game::Round;
using game::RoundSetup;

GltfBuilder small_level(const glm::dvec3& place) {
    GltfBuilder builder;
    const int positions = builder.add_positions({-20, 0, -20, -20, 0, 20, 20, 0, 20, 20, 0, -20});
    const int indices =
        builder.add_accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    builder.show({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const auto put = [&](const char* name, double x, double y, double z, bool solid = false) {
        Json node = {{"name", name}, {"translation", {x, y, z}}};
        if (solid) node["mesh"] = 0;
        builder.json["scenes"][0]["nodes"].push_back(builder.push("nodes", node));
    };
    put("spawn_0", 0, 1.7, 0);
    put("core_0", 0, 1.2, -4);
    put("gate_0_exit", 0, 0, -8);
    put("patrol_0_0", 18, 1.8, 18);
    put("patrol_0_1", 17, 1.8, 18);
    put("crate_0", 0, -30, 0, true);
    const int root = builder.push("nodes", {{"translation", {place.x, place.y, place.z}},
                                            {"children", builder.json["scenes"][0]["nodes"]}});
    builder.json["scenes"][0]["nodes"] = {root};
    return builder;
}

// All props are the same triangle.
Level props_level() {
    GltfBuilder builder = make_quad();
    builder.json["nodes"][0]["name"] = "drone";
    for (const char* name : {"drone_off", "core", "grenade", "bolt"})
        builder.json["scenes"][0]["nodes"].push_back(
            builder.push("nodes", {{"name", name}, {"mesh", 0}}));
    return gltf::import_bytes(builder.glb(), "props", gltf::no_animation,
                              [](const std::string&) { return true; });
}

class GameRound : public testing::Test {
protected:
    explicit GameRound(const glm::dvec3& place = glm::dvec3(0.0))
        : plugin(ENGINE), stage(plugin.api(), 2, RT_ISA_BEST),
          level(gltf::import_bytes(small_level(place).glb(), "test", gltf::no_animation,
                                   game::is_moved)),
          player(stage, level, upload_level(stage, level, 0.1f)) {
        player.describe(0.0);
        stage.commit(RT_STRUCTURE_AUTO, RT_BUILD_BALANCED, nullptr);
        plan = game::plan_from_level(level, player.uploaded());
        ahead.walk[1] = -1;
        ahead.buttons = three_cores::kRun;
    }

    // Ahead until the round is over; the record.
    gameplay::Replay win() {
        Round round(stage, plan, {});
        for (int i = 0; i < 600 && round.tick(ahead);) ++i;
        EXPECT_EQ(round.game().status().outcome, three_cores::Outcome::won);
        EXPECT_TRUE(round.over());
        return round.record();
    }

    static RoundSetup shown(const gameplay::Replay& replay) {
        RoundSetup setup;
        setup.hands = Hands::replay;
        setup.replay = &replay;
        return setup;
    }

    Plugin plugin;
    Stage stage;
    Level level;
    Player player;
    LevelEffects effects{stage, level, player.uploaded().lights};
    three_cores::Plan plan;
    gameplay::TickInput ahead;
};

TEST_F(GameRound, IsWonAndPlaysAgainTheSameWay) {
    const gameplay::Replay record = win();
    EXPECT_EQ(record.level, plan.level);
    ASSERT_GT(record.ticks.size(), 60u);
    Round again(stage, plan, shown(record));
    while (again.tick({})) {
    }
    EXPECT_FALSE(again.astray());
    EXPECT_EQ(again.record(), record);
    EXPECT_EQ(again.game().hash(), record.ticks.back().hash);
}

class FarGameRound : public GameRound {
protected:
    FarGameRound() : GameRound(glm::dvec3(4000000.25, 300.125, -2700000.5)) {}
};

TEST_F(FarGameRound, IsWonAndPlaysAgainTheSameWay) {
    EXPECT_NE(level.origin, glm::dvec3(0.0));
    const gameplay::Replay record = win();
    Round again(stage, plan, shown(record));
    while (again.tick({})) {
    }
    EXPECT_FALSE(again.astray());
    EXPECT_EQ(again.record(), record);
}

// The same vertices relative to another origin are another level.
TEST_F(FarGameRound, TheHashKnowsTheOrigin) {
    const uint64_t before = plan.level;
    level.origin.x += 1.0;
    EXPECT_NE(game::plan_from_level(level, player.uploaded()).level, before);
}

TEST_F(GameRound, AReplayThatWasTamperedWithGoesAstray) {
    gameplay::Replay record = win();
    record.ticks[40].input.walk[0] = 0.5f;
    Round again(stage, plan, shown(record));
    while (again.tick({})) {
    }
    EXPECT_EQ(again.astray(), 40u);
}

TEST_F(GameRound, AnUnfinishedReplayEnds) {
    gameplay::Replay record = win();
    record.ticks.resize(30);
    Round again(stage, plan, shown(record));
    int ticks = 0;
    while (again.tick({})) ++ticks;
    EXPECT_EQ(ticks, 30);
    EXPECT_TRUE(again.over());
    EXPECT_EQ(again.game().status().outcome, three_cores::Outcome::playing);
}

TEST_F(GameRound, PartsGoBackToWhereTheyRest) {
    rt_transform away = plan.crates.at(0).rest;
    away.m[3] += 5;
    stage.api().set_mesh_transform(stage.scene(), plan.crates[0].meshes[0], &away);
    win();
    const gameplay::World world(stage.api(), stage.scene());
    const auto below = [&](double x) { return world.closest({x, -29, 0}, {0, -2, 0}); };
    EXPECT_TRUE(below(-19));
    EXPECT_FALSE(below(24));
}

TEST_F(GameRound, RunsOnAThreadOfItsOwnWhileFramesRender) {
    game::Actors actors(stage, game::find_props(stage, props_level()), effects);
    const gameplay::Replay record = win();
    game::LiveRound live(stage, plan, shown(record), actors);
    Viewpoint view;
    view.position = {0, 1.7, 5};
    Frame frame;
    frame.width = 64;
    frame.height = 36;
    std::vector<uint8_t> pixels(size_t{4} * frame.width * frame.height);
    int batches = 0;
    double before = 1;
    for (int i = 0; i < 2000 && !live.shown().over; ++i) {
        live.advance({}, 3.0 / 60);
        stage.render(view, frame, pixels.data());
        batches += live.finish();
        const double now = live.view(60).position.z;
        EXPECT_LE(now, before + 0.05); // never back
        before = now;
    }
    EXPECT_GT(batches, 10);
    EXPECT_EQ(live.shown().status.outcome, three_cores::Outcome::won);
    EXPECT_EQ(live.round().record(), record);
    EXPECT_TRUE(live.shown().cores.empty());
}

// Five frames a second: as many ticks as the clock says.
TEST_F(GameRound, SlowFramesKeepTheTime) {
    game::Actors actors(stage, game::find_props(stage, props_level()), effects);
    RoundSetup setup;
    game::LiveRound live(stage, plan, setup, actors);
    for (int i = 0; i < 20; ++i) {
        live.advance({}, 0.2);
        live.finish();
    }
    EXPECT_NEAR(live.shown().status.seconds, 4.0, 0.02);
}

// What is only to be seen is in no query of the rules.
TEST_F(GameRound, ActorsAreSeenButNotMet) {
    Round round(stage, plan, {});
    game::Actors actors(stage, game::find_props(stage, props_level()), effects);
    actors.show(round.game());
    round.tick({});
    const gameplay::World world(stage.api(), stage.scene());
    const three_cores::Drone& drone = round.game().drones()[0];
    const gameplay::Vec3 from = drone.position() - 2.0 * drone.forward();
    const gameplay::Vec3 way = 4.0 * drone.forward();
    bool seen = false;
    for (int i = -5; i <= 5; ++i) // through its outline somewhere
        for (int k = -5; k <= 5; ++k) {
            const gameplay::Vec3 shift(0.15 * i, 0.15 * k, 0.15 * i);
            seen = seen || world.closest(from + shift, way);
            EXPECT_FALSE(world.closest(from + shift, way, {three_cores::kSolid, {}}));
        }
    EXPECT_TRUE(seen);
    actors.hide();
    round.tick({});
    for (int i = -5; i <= 5; ++i)
        EXPECT_FALSE(world.closest(from + gameplay::Vec3(0.1 * i, 0.1, 0.1 * i), way));
}

} // namespace
} // namespace host::test
