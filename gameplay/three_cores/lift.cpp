#include "gameplay/three_cores/lift.h"

#include "gameplay/three_cores/rules.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::three_cores {
namespace {

constexpr double kSpeed = 1.4;      // m/s
constexpr double kHesitation = 0.7; // s
constexpr double kPatience = 6;     // s

double seconds_of(const LiftPlan& lift) {
    return std::max(1.0, glm::distance(lift.top, placed(lift.part.rest, Vec3(0))) / kSpeed);
}

} // namespace

Lift::Lift(const LiftPlan& lift)
    : platform_(lift.part, lift.top - placed(lift.part.rest, Vec3(0)), seconds_of(lift)),
      bottom_(placed(lift.part.rest, Vec3(0))), top_(lift.top) {}

bool Lift::update(const rt_api& api, rt_scene scene, const gameplay::CharacterState& rider,
                  std::vector<gameplay::MeshMotion>& motions) {
    const bool ridden = rider.grounded && platform_.carries(rider.ground);
    const bool moved = platform_.is_moving();
    // Who has arrived has to step off before it takes anybody again.
    if (moved)
        standing_ = -1;
    else if (!ridden)
        standing_ = 0;
    else if (standing_ >= 0)
        standing_ += kTick;
    alone_ = ridden || moved || platform_.goal() == 0 ? 0 : alone_ + kTick;
    if (standing_ > kHesitation)
        platform_.set_goal(1 - platform_.goal());
    else if (alone_ > kPatience)
        platform_.set_goal(0);
    const bool sets_out = !moved && platform_.is_moving();
    platform_.update(api, scene, motions);
    return sets_out;
}

bool Lift::can_call(const Vec3& feet, double reach) const {
    const Vec3 here = place();
    const Vec3 away(feet.x - here.x, 0, feet.z - here.z);
    return !platform_.is_moving() && glm::length(away) < reach;
}

bool Lift::call(const Vec3& feet, double reach) {
    if (!can_call(feet, reach)) return false;
    platform_.set_goal(1 - platform_.goal());
    return true;
}

void Lift::add_to(gameplay::StateHash& hash) const {
    platform_.add_to(hash);
    hash.add(standing_);
    hash.add(alone_);
}

} // namespace peregrine::three_cores
