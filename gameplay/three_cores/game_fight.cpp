// Grenades, drones and what they do to one another.
#include "gameplay/three_cores/game.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::three_cores {
namespace {

using namespace gameplay;

constexpr uint32_t kSafeTicks = 3 * kTicksPerSecond; // after a hit
constexpr uint32_t kBoltTicks = 4 * kTicksPerSecond;
constexpr double kBoltRadius = 0.05;
constexpr double kBlastNoise = 25, kCratePush = 6; // m, m/s
constexpr double kLift = 0.22;                     // of a throw, upwards
constexpr double kPreviewStep = 1.0 / 40;

// The distance between a point's way in a tick and the axis of a standing body.
double distance_to_body(const Vec3& from, const Vec3& to, const Capsule& body) {
    double nearest = 1e30;
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
        const Vec3 point = from + (to - from) * (double(i) / kSteps);
        const double rise =
            std::clamp(point.y, body.center.y - body.axis.y, body.center.y + body.axis.y);
        nearest = std::min(nearest, glm::distance(point, Vec3(body.center.x, rise, body.center.z)));
    }
    return nearest;
}

} // namespace

Grenade Game::throw_along(const Vec3& view) const {
    const Vec3 from = eye().position;
    const Vec3 hand = reach(world_, from, from + 0.35 * view, rules_.grenade.radius, {kSolid, {}});
    const Vec3 velocity = rules_.throw_speed * glm::normalize(view + Vec3(0, kLift, 0))
                          + player_.world_velocity(motions_, kTick);
    return {world_, rules_.grenade, double(tick_) * kTick, hand, velocity};
}

std::vector<Vec3> Game::preview(const Vec3& view) const {
    std::vector<Vec3> way;
    if (!cooking_since_) return way;
    Grenade ball = throw_along(view);
    const double fuse = rules_.fuse_seconds - double(tick_ - cooking_since_) * kTick;
    way.push_back(ball.position());
    for (double s = kPreviewStep; s < fuse && ball.motion() != Motion::resting; s += kPreviewStep) {
        ball.advance(world_, double(tick_) * kTick + s);
        way.push_back(ball.position());
    }
    return way;
}

void Game::handle_grenades() {
    if (is_pressed(kThrow) && status_.grenades > 0 && !cooking_since_) cooking_since_ = tick_;
    if (!cooking_since_) return;
    const auto fuse = uint64_t(rules_.fuse_seconds * kTicksPerSecond);
    if (tick_ - cooking_since_ >= fuse) { // held too long
        --status_.grenades;
        cooking_since_ = 0;
        blast(eye().position);
    } else if (!(buttons_ & kThrow)) {
        --status_.grenades;
        thrown_.push_back({throw_along(view_), cooking_since_ + fuse});
        say(Sound::fling, eye().position);
        cooking_since_ = 0;
    }
}

void Game::fly_grenades() {
    for (Thrown& thrown : thrown_) {
        thrown.ball.advance(world_, double(tick_) * kTick);
        for (const Bounce& bounce : thrown.ball.bounces()) {
            if (bounce.approach < 0.5) continue;
            say(Sound::bounce, bounce.contact.point, std::min(bounce.approach / 8, 1.0));
            make_noise(bounce.contact.point, std::min(1.5 * bounce.approach, 10.0));
        }
    }
    std::erase_if(blasts_, [&](const Blast& blast) { return tick_ >= blast.tick + kBlastTicks; });
    std::vector<Vec3> blasts;
    std::erase_if(thrown_, [&](const Thrown& thrown) {
        if (thrown.end > tick_) return false;
        blasts.push_back(thrown.ball.position());
        return true;
    });
    for (const Vec3& point : blasts) blast(point);
}

void Game::blast(const Vec3& point) {
    const Mask solid{kSolid, {}};
    const Vec3 middle = point + Vec3(0, 0.1, 0);
    const auto reaches = [&](const Vec3& place, double radius) {
        return glm::distance(middle, place) < radius && world_.is_free(middle, place, solid);
    };
    say(Sound::blast, point);
    blasts_.push_back({point, tick_});
    for (Drone& drone : drones_) {
        if (drone.is_disabled() || !reaches(drone.position(), rules_.blast_radius)) continue;
        const auto floor = world_.closest(drone.position(), Vec3(0, -50, 0), solid);
        drone.disable(floor ? floor->point.y : drone.position().y - 50);
        say(Sound::disabled, drone.position());
    }
    for (Crate& crate : crates_) {
        const Vec3 away = crate.middle() - middle;
        const double distance = glm::length(away);
        if (distance > rules_.blast_radius || distance == 0) continue;
        const double strength = kCratePush * (1 - distance / rules_.blast_radius);
        crate.push(strength / distance * Vec3(away.x, 0.4 * distance, away.z));
    }
    for (Door& door : doors_)
        if (glm::distance(door.middle(), middle) < 0.6 * rules_.blast_radius) door.set_open(true);
    make_noise(point, kBlastNoise);
    if (reaches(chest(), rules_.blast_hurts)) hurt();
}

std::vector<Sentry> Game::sentries() const {
    std::vector<Sentry> all;
    for (const Drone& drone : drones_) all.push_back(drone.sentry());
    return all;
}

void Game::make_noise(const Vec3& point, double radius) {
    if (is_waited_for()) return;
    watch_.hear(world_, sentries(), {point, radius, 0}, {kSolid, {}});
}

void Game::run_drones() {
    const CharacterState& state = player_.state();
    Target target{state.position, state.height, rules_.character.radius};
    target.conspicuous = 0.2 + 0.8 * status_.light;
    if (tick_ >= safe_until_ && !is_waited_for()) // nobody looks for who was just hit
        watch_.update(world_, sentries(), {&target, 1}, kTick, {kSolid, {}});
    for (size_t i = 0; i < drones_.size(); ++i) {
        Drone& drone = drones_[i];
        const Mood before = drone.mood();
        const bool shoots = drone.update(rules_, watch_.notice(i, 0), chest());
        if (shoots) shoot(drone);
        if (drone.mood() == before || drone.mood() == Mood::calm) continue;
        const bool alarmed = drone.mood() == Mood::alarmed;
        status_.alarms += alarmed;
        if (alarmed || before == Mood::calm)
            say(alarmed ? Sound::alarm : Sound::noticed, drone.position());
    }
}

void Game::shoot(const Drone& drone) {
    const double seconds = glm::distance(chest(), drone.position()) / rules_.bolt_speed;
    const Vec3 aim = chest() + rules_.lead * seconds * player_.world_velocity(motions_, kTick);
    const Vec3 way = glm::normalize(aim - drone.position());
    ProjectileRules rules;
    rules.radius = kBoltRadius;
    rules.mask.layers = kSolid;
    const Vec3 from = drone.position() + 0.4 * way;
    bolts_.push_back({Projectile(rules, double(tick_) * kTick, from, rules_.bolt_speed * way),
                      tick_ + kBoltTicks});
    say(Sound::shot, from);
}

void Game::fly_bolts() {
    bool hit = false;
    const Capsule body = player_.capsule();
    for (Bolt& bolt : bolts_) {
        const Vec3 before = bolt.flight.position();
        bolt.flight.advance(world_, double(tick_) * kTick);
        hit |= distance_to_body(before, bolt.flight.position(), body) < body.radius + kBoltRadius;
    }
    std::erase_if(bolts_,
                  [&](const Bolt& bolt) { return bolt.flight.is_spent() || bolt.end <= tick_; });
    if (hit) hurt();
}

void Game::hurt() {
    if (tick_ < safe_until_) {
        if (player_.state().position.y < plan_.lower.y) begin_again();
        return;
    }
    say(Sound::hurt, chest());
    status_.hurt = 1;
    if (--status_.lives == 0) return finish(Outcome::lost);
    safe_until_ = tick_ + kSafeTicks;
    begin_again();
}

} // namespace peregrine::three_cores
