#include "gameplay/three_cores/bot.h"

#include "gameplay/three_cores/way.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::three_cores {
namespace {

using namespace gameplay;

constexpr size_t kMostPlaces = 60000;
constexpr double kArrived = 0.35, kAstray = 2.5; // m
constexpr double kSight = 13, kTooNear = 4;      // m, to a drone worth a grenade
constexpr double kGoodMiss = 3, kFairMiss = 5;   // m
constexpr double kLateInFuse = 0.7;
constexpr uint64_t kStuckTicks = 90, kThrowEvery = 120;

Vec3 level(const Vec3& v) {
    return {v.x, 0, v.z};
}

// Doors open for who wants through.
Mask mask_of(const Plan& plan, std::vector<rt_mesh>& doors) {
    for (const Part& door : plan.doors)
        doors.insert(doors.end(), door.meshes.begin(), door.meshes.end());
    return {kSolid, doors};
}

Floors explored(const Game& game) {
    std::vector<rt_mesh> doors;
    Floors floors(game.world(), game.rules().character, mask_of(game.plan(), doors));
    for (const Spawn& spawn : game.plan().spawns) floors.explore(spawn.feet, kMostPlaces);
    return floors;
}

void set_view(TickInput& input, const Vec3& view) {
    for (int k = 0; k < 3; ++k) input.view[k] = float(view[k]);
}

} // namespace

Bot::Bot(const Game& game) : floors_(explored(game)) {}

std::optional<Vec3> Bot::goal(const Game& game) const {
    const Vec3 feet = game.player().state().position;
    if (game.status().open) {
        if (game.plan().exits.empty()) return std::nullopt;
        return game.plan().exits[0];
    }
    const uint32_t here = floors_.nearest(feet);
    if (here == Floors::kNone) return std::nullopt;
    const std::vector<double> distances = distances_from(floors_, here);
    std::optional<Vec3> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Core& core : game.cores()) {
        const uint32_t there = core.taken ? Floors::kNone : floors_.nearest(core.position);
        if (there == Floors::kNone || distances[there] >= nearest) continue;
        nearest = distances[there];
        best = core.position;
    }
    return best;
}

void Bot::plan_way(const Game& game) {
    heading_ = goal(game);
    at_ = 0;
    way_.clear();
    if (heading_) way_ = find_way(floors_, game.player().state().position, *heading_);
}

// Where to walk, level and of length 1; 0 where there is nowhere to go.
Vec3 Bot::walk(const Game& game) {
    const Vec3 feet = game.player().state().position;
    const bool reached = at_ >= way_.size();
    if (reached || glm::distance(level(way_[at_]), level(feet)) > kAstray) plan_way(game);
    while (at_ < way_.size() && glm::distance(level(way_[at_]), level(feet)) < kArrived) ++at_;
    Vec3 ahead(0);
    if (at_ < way_.size())
        ahead = level(way_[at_] - feet);
    else if (heading_)
        ahead = level(*heading_ - feet);
    const double length = glm::length(ahead);
    return length > 0.05 ? ahead / length : Vec3(0);
}

const Drone* Bot::prey(const Game& game) const {
    const Vec3 eye = game.eye().position;
    const Drone* nearest = nullptr;
    for (const Drone& drone : game.drones()) {
        const double distance = glm::distance(drone.position(), eye);
        if (drone.is_disabled() || distance > kSight || distance < kTooNear) continue;
        if (nearest && glm::distance(nearest->position(), eye) <= distance) continue;
        if (game.world().is_free(eye, drone.position(), {kSolid, {}})) nearest = &drone;
    }
    return nearest;
}

// Of throws towards the drone at many heights the one that goes off nearest to it, in its sight.
Bot::Throw Bot::best_throw(const Game& game, const Drone& drone) const {
    const Vec3 eye = game.eye().position;
    const Vec3 way = level(drone.position() - eye);
    const double length = glm::length(way);
    Throw best;
    if (length == 0) return best;
    for (double rise = -0.6; rise < 1.3; rise += 0.19) {
        const Vec3 view = glm::normalize(way / length + Vec3(0, rise, 0));
        const std::vector<Vec3> arc = game.preview(view);
        if (arc.empty() || glm::distance(arc.back(), eye) < game.rules().blast_hurts + 1) continue;
        const Vec3 end = arc.back() + Vec3(0, 0.1, 0);
        const double miss = glm::distance(end, drone.position());
        if (miss < best.miss && game.world().is_free(end, drone.position(), {kSolid, {}}))
            best = {view, miss};
    }
    return best;
}

// Takes a grenade into the hand at the sight of a drone, and lets go once it is worth it.
void Bot::fight(const Game& game, TickInput& input) {
    const Drone* drone = prey(game);
    if (!cooking_) {
        cooking_ = drone && game.status().grenades > 0 && game.ticks() >= rest_until_;
        if (cooking_) input.buttons |= kThrow;
        return;
    }
    if (game.status().cooking == 0) { // a hit took it out of the hand
        cooking_ = false;
        return;
    }
    input.walk[0] = input.walk[1] = 0;
    const bool late = game.status().cooking > kLateInFuse;
    if (drone) {
        const Throw thrown = best_throw(game, *drone);
        if (thrown.miss < 1e30) set_view(input, thrown.view);
        cooking_ = thrown.miss > (late ? kFairMiss : kGoodMiss);
    }
    if (cooking_ && late) { // away with it, forwards
        set_view(input, glm::normalize(Vec3(input.view[0], 0.5, input.view[2])));
        cooking_ = false;
    }
    if (cooking_)
        input.buttons |= kThrow;
    else
        rest_until_ = game.ticks() + kThrowEvery;
}

void Bot::get_unstuck(const Game& game, TickInput& input) {
    const Vec3 feet = game.player().state().position;
    const bool still = input.walk[0] == 0 && input.walk[1] == 0;
    if (still || glm::distance(feet, anchor_) > 0.5) {
        anchor_ = feet;
        anchored_ = game.ticks();
        return;
    }
    const uint64_t ticks = game.ticks() - anchored_;
    if (ticks < kStuckTicks) return;
    if (ticks % kStuckTicks == 0) plan_way(game);
    if (ticks % 45 == 0) input.buttons |= kJump;
    // Sideways now and then: round a corner that the way cuts.
    if (ticks / kStuckTicks % 3 == 2) std::swap(input.walk[0], input.walk[1]);
}

TickInput Bot::next(const Game& game) {
    TickInput input;
    const Vec3 ahead = walk(game);
    input.walk[0] = float(ahead.x);
    input.walk[1] = float(ahead.z);
    set_view(input, ahead == Vec3(0) ? game.eye().forward : ahead);
    fight(game, input);
    if (game.status().charge > 0 || !game.bolts().empty()) input.buttons |= kRun;
    const Vec3 feet = game.player().state().position;
    for (const Door& door : game.doors())
        if (!door.is_open() && game.ticks() % 60 == 0
            && glm::distance(door.middle(), feet + Vec3(0, 1.2, 0)) < game.rules().use_reach)
            input.buttons |= kUse;
    get_unstuck(game, input);
    return input;
}

} // namespace peregrine::three_cores
