#include "gameplay/three_cores/game.h"

#include "gameplay/random.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <stdexcept>

namespace peregrine::three_cores {
namespace {

using namespace gameplay;

constexpr double kStride = 0.85; // m
constexpr double kLoudFall = 5;  // m/s
constexpr double kVoid = 8;      // m below the level
constexpr double kAtExit = 1.6;  // m
constexpr double kDoorGap = 1.3; // m round a hinge that a closing leaf keeps clear of
constexpr double kGateSeconds = 4;
constexpr uint32_t kLightEvery = 6; // ticks
constexpr double kLightFollows = 3; // 1/s
constexpr uint32_t kDeeds = kJump | kThrow | kUse;

// A grille rises by its height, less a little that stays in sight.
Vec3 rise(const Part& part) {
    return {0, 0.92 * (part.upper.y - part.lower.y), 0};
}

} // namespace

Game::Game(const rt_api& api, rt_scene scene, const Plan& plan, const Settings& settings)
    : api_(&api), scene_(scene), plan_(plan), rules_(rules_of(settings.difficulty)),
      settings_(settings), world_(api, scene), player_(world_, rules_.character, {kSolid, {}}),
      watch_(rules_.sentry), light_(plan.lamps) {
    if (plan.spawns.empty()) throw PlanError("the level has no place to begin at");
    for (const Part& door : plan.doors) doors_.emplace_back(door);
    for (const Part& crate : plan.crates) crates_.emplace_back(crate);
    for (const LiftPlan& lift : plan.lifts) lifts_.emplace_back(lift);
    for (const Part& gate : plan.gates) gates_.emplace_back(gate, rise(gate), kGateSeconds);
    for (const Vec3& core : plan.cores) cores_.push_back({core});
    Random random(settings.seed);
    for (const std::vector<Vec3>& round : plan.patrols)
        if (!round.empty()) drones_.emplace_back(round, 5 * random.uniform());
    status_.lives = rules_.lives;
    status_.grenades = rules_.grenades;
    begin_again();
    move_parts();
    commit();
    measure();
}

void Game::tick(const TickInput& input) {
    events_.clear();
    if (status_.outcome != Outcome::playing) return;
    ++tick_;
    held_ = buttons_;
    buttons_ = input.buttons & kButtons;
    view_ = {input.view[0], input.view[1], input.view[2]};
    idle_ = idle_ && input.walk[0] == 0 && input.walk[1] == 0 && !(buttons_ & kDeeds);
    if (is_pressed(kUse)) use();
    move_parts();
    commit();
    move_player(input);
    handle_grenades();
    fly_grenades();
    run_drones();
    fly_bolts();
    collect();
    if (player_.state().position.y < plan_.lower.y - kVoid) hurt();
    measure();
}

// The nearest door, with the leaf beside it, or else a lift.
void Game::use() {
    if (const Door* nearest = door_at_hand()) {
        const bool open = !nearest->is_open();
        for (Door& door : doors_)
            if (glm::distance(door.middle(), nearest->middle()) < rules_.use_reach)
                door.set_open(open);
        say(Sound::door, nearest->middle());
        return;
    }
    for (Lift& lift : lifts_)
        if (lift.call(player_.state().position, rules_.use_reach))
            return say(Sound::lift, lift.place());
}

const Door* Game::door_at_hand() const {
    const Vec3 hand = player_.state().position + Vec3(0, 1.2, 0);
    const auto away = [&](const Door& door) { return glm::distance(door.middle(), hand); };
    const auto nearest = std::ranges::min_element(doors_, {}, away);
    return nearest != doors_.end() && away(*nearest) < rules_.use_reach ? &*nearest : nullptr;
}

Use Game::usable() const {
    if (const Door* door = door_at_hand())
        return door->is_open() ? Use::close_door : Use::open_door;
    const Vec3 feet = player_.state().position;
    const auto comes = [&](const Lift& lift) { return lift.can_call(feet, rules_.use_reach); };
    return std::ranges::any_of(lifts_, comes) ? Use::move_lift : Use::nothing;
}

void Game::move_parts() {
    motions_.clear();
    const CharacterState& state = player_.state();
    for (Door& door : doors_) {
        const Vec3 away = door.middle() - state.position;
        const bool near =
            glm::length(Vec3(away.x, 0, away.z)) < kDoorGap && away.y > -0.5 && away.y < 2.5;
        door.update(*api_, scene_, near, motions_);
    }
    for (Lift& lift : lifts_)
        if (lift.update(*api_, scene_, state, motions_)) say(Sound::lift, lift.place());
    for (Platform& gate : gates_) gate.update(*api_, scene_, motions_);
    for (Crate& crate : crates_) crate.update(*api_, scene_, world_, motions_);
}

void Game::commit() {
    if (api_->commit_scene(scene_, &settings_.commit, nullptr) != RT_OK)
        throw std::runtime_error(api_->get_last_error());
}

void Game::move_player(const TickInput& input) {
    const bool grounded = player_.state().grounded != 0;
    const double falling = -player_.state().velocity.y;
    const bool running = (buttons_ & kRun) != 0;
    const double pace = running || (buttons_ & kCrouch) != 0 ? 1 : rules_.walk;
    CharacterInput wish;
    wish.walk = pace * Vec3(input.walk[0], 0, input.walk[1]);
    wish.jump = is_pressed(kJump);
    wish.crouch = (buttons_ & kCrouch) != 0;
    wish.motions = motions_;
    player_.update(wish, kTick);
    const bool lands = !grounded && player_.state().grounded;
    if (grounded && wish.jump && !player_.state().grounded)
        say(Sound::jump, player_.state().position);
    make_steps(running && !wish.crouch, lands ? falling : 0);
}

void Game::make_steps(bool running, double fall_speed) {
    const CharacterState& state = player_.state();
    if (fall_speed > 1) {
        say(Sound::land, state.position, std::min(fall_speed / kLoudFall, 1.0));
        if (fall_speed > kLoudFall) make_noise(state.position, rules_.run_noise);
    }
    if (!state.grounded) return;
    stride_ += glm::length(Vec3(state.velocity.x, 0, state.velocity.z)) * kTick;
    if (stride_ < (running ? 1.5 : 1.0) * kStride) return;
    stride_ = 0;
    const bool crouched = (buttons_ & kCrouch) != 0;
    say(Sound::step, state.position, running ? 1 : crouched ? 0.15 : 0.45);
    if (running) make_noise(state.position, rules_.run_noise);
}

void Game::collect() {
    for (Core& core : cores_) {
        if (core.taken || glm::distance(core.position, chest()) > rules_.core_reach) continue;
        core.taken = true;
        say(Sound::core, core.position);
        const auto away = [&](const Spawn& spawn) {
            return glm::distance(spawn.feet, core.position);
        };
        spawn_ = uint32_t(std::ranges::min_element(plan_.spawns, {}, away) - plan_.spawns.begin());
    }
    const bool all = std::ranges::all_of(cores_, &Core::taken);
    if (all && !status_.open) {
        status_.open = true;
        for (Platform& gate : gates_) gate.set_goal(1);
        const Vec3 where = plan_.exits.empty() ? chest() : plan_.exits[0];
        say(Sound::gate, where);
    }
    const Vec3 feet = player_.state().position;
    for (const Vec3& exit : plan_.exits)
        if (all && glm::distance(feet, exit) < kAtExit) return finish(Outcome::won);
}

void Game::begin_again() {
    const Spawn& spawn = plan_.spawns[spawn_];
    player_.place(spawn.feet + Vec3(0, 0.02, 0));
    view_ = spawn.forward;
    cooking_since_ = 0;
    idle_ = true;
    bolts_.clear();
    watch_.reset(drones_.size(), 1);
}

void Game::finish(Outcome outcome) {
    status_.outcome = outcome;
    say(outcome == Outcome::won ? Sound::won : Sound::lost, chest());
}

void Game::measure() {
    status_.cores = uint32_t(std::ranges::count_if(cores_, &Core::taken));
    status_.cores_total = uint32_t(cores_.size());
    status_.drones_total = uint32_t(drones_.size());
    status_.drones = uint32_t(std::ranges::count(drones_, false, &Drone::is_disabled));
    status_.seconds = double(tick_) / kTicksPerSecond;
    status_.hurt = std::max(0.0, status_.hurt - kTick);
    status_.cooking =
        cooking_since_ ? double(tick_ - cooking_since_ + 1) * kTick / rules_.fuse_seconds : 0;
    if (tick_ % kLightEvery == 0) {
        const double light = light_.measure(world_, chest(), glows());
        const double part = tick_ == 0 ? 1 : kLightFollows * kTick * kLightEvery;
        status_.light += std::min(part, 1.0) * (light - status_.light);
    }
    status_.seen = status_.alarm = status_.charge = 0;
    status_.alarmed = false;
    for (size_t i = 0; i < drones_.size(); ++i) {
        if (drones_[i].is_disabled()) continue;
        status_.seen = std::max(status_.seen, watch_.notice(i, 0).visibility);
        status_.alarm = std::max(status_.alarm, drones_[i].suspicion());
        status_.charge = std::max(status_.charge, drones_[i].charge());
        status_.alarmed |= drones_[i].mood() == Mood::alarmed;
    }
    status_.use = usable();
    status_.score = score();
}

// What was done counts; what was left over, once the round is won.
uint32_t Game::score() const {
    uint32_t score = 1000 * status_.cores + 250 * (status_.drones_total - status_.drones);
    if (status_.outcome != Outcome::won) return score;
    constexpr double kPar = 600; // s
    score += uint32_t(5 * std::max(0.0, kPar - status_.seconds));
    score += 500 * status_.lives + 100 * status_.grenades;
    return status_.alarms == 0 ? score + 2000 : score;
}

std::vector<Glow> Game::glows() const {
    std::vector<Glow> glows;
    for (const Drone& drone : drones_)
        if (!drone.is_disabled()) glows.push_back(beam_of(drone, rules_.sentry));
    for (const Core& core : cores_)
        if (!core.taken) glows.push_back(glow_of_core(core.position));
    for (const Blast& blast : blasts_) glows.push_back(glow_of(blast, tick_));
    return glows;
}

Eye Game::eye() const {
    const CharacterState& state = player_.state();
    return {state.position + Vec3(0, state.height - 0.16, 0), view_};
}

Vec3 Game::chest() const {
    return player_.state().position + Vec3(0, 0.7 * player_.state().height, 0);
}

void Game::say(Sound sound, const Vec3& point, double strength) {
    events_.push_back({sound, point, strength});
}

uint64_t Game::hash() const {
    StateHash hash;
    hash.add(tick_);
    add(hash, player_.state());
    for (const Notice& notice : watch_.notices()) add(hash, notice);
    for (const Drone& drone : drones_) drone.add_to(hash);
    for (const Bolt& bolt : bolts_) {
        hash.add(bolt.flight.position());
        hash.add(bolt.flight.velocity());
    }
    for (const Thrown& thrown : thrown_) {
        thrown.ball.add_to(hash);
        hash.add(thrown.end);
    }
    for (const Blast& blast : blasts_) {
        hash.add(blast.point);
        hash.add(blast.tick);
    }
    for (const Door& door : doors_) door.add_to(hash);
    for (const Lift& lift : lifts_) lift.add_to(hash);
    for (const Platform& gate : gates_) gate.add_to(hash);
    for (const Crate& crate : crates_) crate.add_to(hash);
    for (const Core& core : cores_) hash.add(uint32_t(core.taken));
    hash.add(uint32_t(status_.outcome));
    hash.add(status_.lives);
    hash.add(status_.grenades);
    hash.add(status_.score);
    hash.add(status_.light);
    hash.add(stride_);
    hash.add(spawn_);
    hash.add(status_.alarms);
    hash.add(buttons_);
    hash.add(cooking_since_);
    hash.add(safe_until_);
    hash.add(uint32_t(idle_));
    return hash.value();
}

} // namespace peregrine::three_cores
