#pragma once

#include "gameplay/state_hash.h"

#include <span>
#include <type_traits>

namespace peregrine::gameplay {

// Lengths in metres, speeds in metres a second.
struct CharacterRules {
    double radius = 0.3;
    double height = 1.8;
    double crouched_height = 1.0; // at least two radii
    double skin = 0.002;          // the distance kept to everything
    double step_height = 0.35;
    double slope_limit = 0.6427876; // cosine of the steepest slope that carries: 50 degrees
    double speed = 4;
    double crouched_speed = 2;
    double acceleration = 50;
    double air_acceleration = 10;
    double jump_speed = 4.5;
    double gravity = 9.81;
    double fall_speed = 50;
};

// How a rigid mesh moved since the last update, as given to rt_set_mesh_transform.
struct MeshMotion {
    rt_mesh mesh;
    rt_transform before, after;
};

struct CharacterInput {
    Vec3 walk{0}; // where to, along x and z; up to length 1, which is full speed
    bool jump = false;
    bool crouch = false;
    std::span<const MeshMotion> motions{}; // borrowed for the call
};

// All that an update depends on and changes.
struct CharacterState {
    Vec3 position{0};      // the lowest point
    Vec3 velocity{0};      // on the ground: relative to it
    Vec3 ground_normal{0}; // 0 in the air
    double height = 0;     // now; 0 until the first update: standing
    rt_mesh ground{};      // the mesh that carries it; null in the air
    uint32_t grounded = 0;
    uint32_t squeezed = 0; // 1: something moved into it, and there is no room to give way
};
static_assert(sizeof(CharacterState) == 96 && std::is_trivially_copyable_v<CharacterState>);

// Of the mesh handle the index alone: generations differ between scenes.
void add(StateHash& hash, const CharacterState& state);

// A person who walks: an upright capsule that slides along walls, climbs steps, stands on slopes,
// jumps, crouches, rides on what carries it and gives way to what pushes it. Moved by sweeps alone,
// it cannot get to where the capsule does not fit. An update takes a fixed time step; its result
// depends on the state, the input and the world alone, to the bit.
class Character {
public:
    explicit Character(const World& world, const CharacterRules& rules = {}, const Mask& mask = {})
        : world_(world), rules_(rules), mask_(mask) {}

    void place(const Vec3& position);
    void update(const CharacterInput& input, double seconds);

    const CharacterState& state() const { return state_; }
    void restore(const CharacterState& state) { state_ = state; }
    const CharacterRules& rules() const { return rules_; }

    // The capsule as it is now.
    Capsule capsule() const;

    // Its velocity with that of what carries it, which went as `motions` say in an update.
    Vec3 world_velocity(std::span<const MeshMotion> motions, double seconds) const;

private:
    void take_stance(bool crouch);
    rt_mesh carrier(std::span<const MeshMotion> motions) const;
    Vec3 ride(std::span<const MeshMotion> motions); // returns how far it was carried
    void walk(const Vec3& wish, double seconds, const Vec3& ground_velocity);
    void fall(const Vec3& wish, double seconds, std::span<const MeshMotion> motions,
              const Vec3& ridden);
    void land(double rise, double seconds, std::span<const MeshMotion> motions);
    void leave_ground(const Vec3& ground_velocity);

    World world_;
    CharacterRules rules_;
    Mask mask_;
    CharacterState state_;
};

} // namespace peregrine::gameplay
