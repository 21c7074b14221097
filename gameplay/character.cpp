#include "gameplay/character.h"

#include "gameplay/body.h"
#include "gameplay/ground.h"
#include "gameplay/slide.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace peregrine::gameplay {
namespace {

constexpr double kLandingSkins = 2;
constexpr double kLandingEdge = 0.5; // on an edge nearer to the axis than 0.87 radii

Vec3 horizontal(const Vec3& v) {
    return {v.x, 0, v.z};
}

bool is_same(const rt_mesh& a, const rt_mesh& b) {
    return a.index == b.index && a.generation == b.generation;
}

// From one speed to another, by `most` at most.
Vec3 towards(const Vec3& from, const Vec3& to, double most) {
    const Vec3 change = to - from;
    const double length = glm::length(change);
    return length <= most ? to : from + change * (most / length);
}

Vec3 limited(const Vec3& wish) {
    const Vec3 flat = horizontal(wish);
    const double length = glm::length(flat);
    return length > 1 ? flat / length : flat;
}

// Where a point that moves with a mesh gets to. The matrices are solved, not inverted:
// Cramer's rule for the point's place in the mesh.
Vec3 carried(const MeshMotion& motion, const Vec3& point) {
    const double* a = motion.before.m;
    const double* b = motion.after.m;
    const Vec3 x(a[0], a[4], a[8]), y(a[1], a[5], a[9]), z(a[2], a[6], a[10]);
    const Vec3 offset = point - Vec3(a[3], a[7], a[11]);
    const Vec3 yz = glm::cross(y, z);
    const double determinant = glm::dot(x, yz);
    const Vec3 local = Vec3(glm::dot(offset, yz), glm::dot(x, glm::cross(offset, z)),
                            glm::dot(x, glm::cross(y, offset)))
                       / determinant;
    return {b[0] * local.x + b[1] * local.y + b[2] * local.z + b[3],
            b[4] * local.x + b[5] * local.y + b[6] * local.z + b[7],
            b[8] * local.x + b[9] * local.y + b[10] * local.z + b[11]};
}

Vec3 displacement(std::span<const MeshMotion> motions, const rt_mesh& mesh, const Vec3& point) {
    for (const MeshMotion& motion : motions)
        if (is_same(motion.mesh, mesh)) return carried(motion, point) - point;
    return Vec3(0);
}

} // namespace

void add(StateHash& hash, const CharacterState& state) {
    hash.add(state.position);
    hash.add(state.velocity);
    hash.add(state.ground_normal);
    hash.add(state.height);
    hash.add(state.ground.index);
    hash.add(state.grounded);
    hash.add(state.squeezed);
}

void Character::place(const Vec3& position) {
    state_ = {};
    state_.position = position;
    state_.height = rules_.height;
}

Capsule Character::capsule() const {
    const double height = state_.height > 0 ? state_.height : rules_.height;
    return Body(world_, rules_, mask_, height).capsule(state_.position);
}

void Character::update(const CharacterInput& input, double seconds) {
    if (!(seconds > 0)) return;
    if (state_.height <= 0) state_.height = rules_.height;
    const Vec3 ridden = ride(input.motions);
    const Vec3 ground_velocity = ridden / seconds;
    const Body body(world_, rules_, mask_, state_.height);
    state_.squeezed = !body.depenetrate(state_.position);
    take_stance(input.crouch);

    const bool crouched = state_.height < rules_.height;
    const Vec3 wish = limited(input.walk) * (crouched ? rules_.crouched_speed : rules_.speed);
    if (state_.grounded && input.jump) {
        leave_ground(ground_velocity);
        state_.velocity.y += rules_.jump_speed;
    }
    if (state_.grounded)
        walk(wish, seconds, ground_velocity);
    else
        fall(wish, seconds, input.motions, ridden);
}

Vec3 Character::world_velocity(std::span<const MeshMotion> motions, double seconds) const {
    if (!state_.grounded) return state_.velocity;
    return state_.velocity + displacement(motions, state_.ground, state_.position) / seconds;
}

// Getting up takes room: it is what a sweep of the low body upwards passes through.
void Character::take_stance(bool crouch) {
    if (crouch) {
        state_.height = std::min(state_.height, rules_.crouched_height);
        return;
    }
    const double rise = rules_.height - state_.height;
    if (rise <= 0) return;
    const Body body(world_, rules_, mask_, state_.height);
    Vec3 risen = state_.position;
    if (!body.advance(risen, Vec3(0, rise, 0))) state_.height = rules_.height;
}

// The mesh that takes it along: its ground, or in the air what moved into it.
rt_mesh Character::carrier(std::span<const MeshMotion> motions) const {
    if (state_.grounded || motions.empty()) return state_.ground;
    const Body body(world_, rules_, mask_, state_.height);
    const auto overlap = body.overlap(state_.position);
    return overlap ? overlap->mesh : rt_mesh{};
}

// What goes along with the carrier is not in the way, though it has moved already.
Vec3 Character::ride(std::span<const MeshMotion> motions) {
    const Vec3 way = displacement(motions, carrier(motions), state_.position);
    if (way == Vec3(0)) return way;
    std::vector<rt_mesh> ignored(mask_.ignored.begin(), mask_.ignored.end());
    for (const MeshMotion& motion : motions)
        if (carried(motion, state_.position) - state_.position == way)
            ignored.push_back(motion.mesh);
    const Body body(world_, rules_, {mask_.layers, ignored}, state_.height);
    body.advance(state_.position, way);
    return way;
}

void Character::leave_ground(const Vec3& ground_velocity) {
    state_.velocity += ground_velocity;
    state_.ground_normal = Vec3(0);
    state_.ground = {};
    state_.grounded = 0;
}

void Character::walk(const Vec3& wish, double seconds, const Vec3& ground_velocity) {
    const Body body(world_, rules_, mask_, state_.height);
    state_.velocity = towards(horizontal(state_.velocity), wish, rules_.acceleration * seconds);
    const Vec3 start = state_.position;
    if (!slide_on_ground(body, state_.position, state_.ground_normal, state_.velocity * seconds))
        state_.velocity = horizontal(state_.position - start) / seconds;

    // Steps and slopes down are followed.
    if (const auto ground = find_ground(body, state_.position, rules_.step_height)) {
        state_.position = ground->position;
        state_.ground_normal = ground->normal;
        state_.ground = ground->mesh;
    } else {
        leave_ground(ground_velocity);
    }
}

// `ridden`: how far it went with something else already; its own motion counts from before that.
void Character::fall(const Vec3& wish, double seconds, std::span<const MeshMotion> motions,
                     const Vec3& ridden) {
    const Body body(world_, rules_, mask_, state_.height);
    const Vec3 before = state_.velocity;
    Vec3 after = before;
    if (wish != Vec3(0)) {
        after = towards(horizontal(before), wish, rules_.air_acceleration * seconds);
        after.y = before.y;
    }
    after.y = std::max(before.y - rules_.gravity * seconds, -rules_.fall_speed);
    state_.velocity = after;
    // The mean of both speeds: exact for a constant acceleration, so that a jump is as high at
    // every time step.
    const Vec3 way = (before + after) * (0.5 * seconds);
    slide_in_air(body, state_.position, state_.velocity, way - ridden);
    land(after.y, seconds, motions);
}

// On ground that it falls onto, or that rises faster than it does.
void Character::land(double rise, double seconds, std::span<const MeshMotion> motions) {
    if (rise > 0 && motions.empty()) return;
    const Body body(world_, rules_, mask_, state_.height);
    const auto ground =
        find_ground(body, state_.position, kLandingSkins * rules_.skin, kLandingEdge);
    if (!ground) return;
    const Vec3 ground_velocity = displacement(motions, ground->mesh, ground->position) / seconds;
    if (rise > ground_velocity.y) return;
    state_.position = ground->position;
    state_.velocity = horizontal(state_.velocity - ground_velocity);
    state_.ground_normal = ground->normal;
    state_.ground = ground->mesh;
    state_.grounded = 1;
}

} // namespace peregrine::gameplay
