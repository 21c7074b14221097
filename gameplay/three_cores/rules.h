#pragma once

#include "gameplay/character.h"
#include "gameplay/grenade.h"
#include "gameplay/sentry.h"

// What can be tuned.
namespace peregrine::three_cores {

enum class Difficulty : uint32_t { easy, normal, hard };

constexpr uint32_t kTicksPerSecond = 60;
constexpr double kTick = 1.0 / kTicksPerSecond;

// Bits of gameplay::TickInput.buttons.
enum Button : uint32_t {
    kJump = 1,
    kCrouch = 2,
    kRun = 4,
    kThrow = 8, // held: the grenade cooks; let go: it flies
    kUse = 16,
    kButtons = 31
};

// Layers of meshes: what is solid asks queries for kSolid. The level has all bits; what is only to
// be seen (drones, cores, grenades) has kShown alone.
constexpr uint32_t kSolid = 1, kShown = 2;

struct Rules {
    uint32_t lives = 3;
    uint32_t grenades = 6;
    double drone_speed = 1.4;    // m/s
    double drone_turn = 2.0;     // 1/s: how fast a gaze follows
    double charge_seconds = 1.2; // from alarm to a shot, while in sight
    double lead = 0.6;           // of the way that its target goes meanwhile, a shot allows for
    double bolt_speed = 22;      // m/s
    double fuse_seconds = 3;
    double throw_speed = 13;
    double blast_radius = 6;         // of what a blast disables and pushes
    double blast_hurts = 2.5;        // of what it does to the player
    double walk = 0.5, crouch = 0.3; // of the running speed
    double run_noise = 7;            // metres
    bool is_patient = false; // nobody looks for who has not done anything yet where they begin
    double use_reach = 2.2;
    double core_reach = 1.3;
    gameplay::CharacterRules character;
    gameplay::GrenadeRules grenade;
    gameplay::SentryRules sentry;
};

Rules rules_of(Difficulty difficulty);

} // namespace peregrine::three_cores
