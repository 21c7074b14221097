#include "gameplay/three_cores/crate.h"

#include "gameplay/three_cores/rules.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::three_cores {
namespace {

constexpr double kGap = 0.012;  // m: kept to floor and walls
constexpr double kFriction = 5; // m/s^2
constexpr double kGravity = 9.81, kFallSpeed = 20;

// Of a turn about Y alone, from the sine and cosine of its angle.
void set_turn(gameplay::Box& box, double sine, double cosine) {
    box.rotation[1] = std::copysign(std::sqrt(std::max(0.0, 0.5 - 0.5 * cosine)), sine);
    box.rotation[3] = std::sqrt(std::max(0.0, 0.5 + 0.5 * cosine));
}

} // namespace

Crate::Crate(const Part& part) : mover_(part) {
    const auto& m = part.rest.m;
    const double scale[3] = {glm::length(Vec3(m[0], m[4], m[8])),
                             glm::length(Vec3(m[1], m[5], m[9])),
                             glm::length(Vec3(m[2], m[6], m[10]))};
    box_.center = placed(part.rest, 0.5 * (part.lower + part.upper));
    for (int k = 0; k < 3; ++k)
        box_.half_size[k] = std::max(0.01, 0.5 * scale[k] * (part.upper[k] - part.lower[k]) - kGap);
    set_turn(box_, -m[8] / scale[0], m[0] / scale[0]);
}

bool Crate::fits(const gameplay::World& world, const Vec3& offset) const {
    gameplay::Box box = box_;
    box.center += offset;
    return !world.overlaps(box, {kSolid, mover_.part().meshes});
}

void Crate::update(const rt_api& api, rt_scene scene, const gameplay::World& world,
                   std::vector<gameplay::MeshMotion>& motions) {
    if (velocity_ == Vec3(0)) return;
    const auto try_move = [&](int axis) {
        Vec3 next = offset_;
        next[axis] += velocity_[axis] * kTick;
        if (velocity_[axis] != 0 && fits(world, next))
            offset_ = next;
        else
            velocity_[axis] = 0;
    };
    try_move(0);
    try_move(2);
    velocity_.y = std::max(velocity_.y - kGravity * kTick, -kFallSpeed);
    try_move(1);
    const double speed = glm::length(Vec3(velocity_.x, 0, velocity_.z));
    const double left = std::max(0.0, speed - kFriction * kTick);
    const double kept = speed > 0 ? left / speed : 0;
    velocity_.x *= kept;
    velocity_.z *= kept;
    mover_.move(api, scene, shifted(mover_.part().rest, offset_), motions);
}

void Crate::add_to(gameplay::StateHash& hash) const {
    hash.add(offset_);
    hash.add(velocity_);
}

} // namespace peregrine::three_cores
