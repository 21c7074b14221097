#include "support/small_game.h"

#include "gameplay/random.h"
#include "gameplay/state_hash.h"
#include "support/throws.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::test {
namespace {

using namespace gameplay;

constexpr double kStep = 1.0 / SmallGame::kTicksPerSecond;
constexpr size_t kMostGrenades = 6;
constexpr uint64_t kLiftTicks = 180; // up, and down again
constexpr double kLiftSpeed = 0.5;   // m/s

} // namespace

SmallGame::SmallGame(rt_isa isa, uint32_t threads)
    : arena_(isa, threads), world_(arena_.world()), character_(world_) {
    if (!arena_.is_supported()) return;
    add_playground(arena_);
    lift_ = arena_.add_mover({-0.8, -0.2, -0.8}, {0.8, 0.01, 0.8});
    arena_.commit();
    character_.place({0, 0.1, 0});
    sentries_ = {{{4.5, 1.7, 4.5}, {-1, 0, -1}}, {{-4.5, 1.7, -4.5}, {1, 0, 1}}};
    watch_.reset(sentries_.size(), 1);
}

uint64_t SmallGame::play_tick(const TickInput& input) {
    ++tick_;
    walk(input, move_lift());
    if (input.buttons & fire) throw_grenade({input.view[0], input.view[1], input.view[2]});
    fly_grenades();
    watch();
    return hash();
}

MeshMotion SmallGame::move_lift() {
    const bool up = (tick_ - 1) / kLiftTicks % 2 == 0;
    return arena_.shift(lift_, {0, (up ? 1 : -1) * kLiftSpeed * kStep, 0});
}

void SmallGame::walk(const TickInput& input, const MeshMotion& lift) {
    CharacterInput wish;
    wish.walk = {input.walk[0], 0, input.walk[1]};
    wish.jump = input.buttons & jump;
    wish.crouch = input.buttons & crouch;
    wish.motions = {&lift, 1};
    const bool stood = character_.state().grounded;
    character_.update(wish, kStep);
    events_.jumps += stood && wish.jump && !character_.state().grounded;
    events_.rides += character_.state().ground.index == lift_.index;
}

void SmallGame::throw_grenade(const Vec3& view) {
    const Vec3 eye = character_.state().position + Vec3(0, 0.9 * character_.state().height, 0);
    const GrenadeRules rules;
    const Vec3 hand = reach(world_, eye, eye + 0.4 * view, rules.radius);
    const Vec3 velocity = 10.0 * view + character_.state().velocity;
    if (grenades_.size() == kMostGrenades) grenades_.pop_front();
    grenades_.emplace_back(world_, rules, double(tick_ - 1) / kTicksPerSecond, hand, velocity);
    ++events_.thrown;
}

void SmallGame::fly_grenades() {
    for (Grenade& grenade : grenades_) {
        const bool moved = grenade.motion() != Motion::resting;
        grenade.advance(world_, double(tick_) / kTicksPerSecond);
        for (const Bounce& bounce : grenade.bounces())
            watch_.hear(world_, sentries_, {bounce.contact.point, 4 * bounce.approach, 0});
        events_.bounces += grenade.bounces().size();
        events_.rested += moved && grenade.motion() == Motion::resting;
    }
}

void SmallGame::watch() {
    const CharacterState& state = character_.state();
    const Target target{state.position, state.height, 0.3};
    watch_.update(world_, sentries_, {&target, 1}, kStep);
    events_.alarms += std::ranges::any_of(
        watch_.notices(), [](const Notice& notice) { return notice.mood == Mood::alarmed; });
}

uint64_t SmallGame::hash() const {
    StateHash hash;
    hash.add(tick_);
    add(hash, character_.state());
    for (const Grenade& grenade : grenades_) grenade.add_to(hash);
    for (const Notice& notice : watch_.notices()) add(hash, notice);
    return hash.value();
}

std::vector<TickInput> minute_of_inputs(uint64_t seed) {
    Random random(seed);
    std::vector<TickInput> inputs;
    Vec3 goal(0), view(1, 0, 0);
    for (uint32_t tick = 0; tick < 60 * SmallGame::kTicksPerSecond; ++tick) {
        if (tick % 40 == 0) goal = random.in_ball();
        if (tick % 90 == 0) view = glm::normalize(random.in_ball() + Vec3(0, 0.3, 0));
        TickInput input;
        input.walk[0] = float(goal.x);
        input.walk[1] = float(goal.z);
        for (int axis = 0; axis < 3; ++axis) input.view[axis] = float(view[axis]);
        if (random.below(50) == 0) input.buttons |= SmallGame::jump;
        if (tick % 600 > 500) input.buttons |= SmallGame::crouch;
        if (tick % 45 == 20) input.buttons |= SmallGame::fire;
        inputs.push_back(input);
    }
    return inputs;
}

} // namespace peregrine::test
