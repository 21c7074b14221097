#include "gameplay/three_cores/door.h"

#include "gameplay/three_cores/rules.h"

#include <algorithm>

namespace peregrine::three_cores {
namespace {

constexpr double kSeconds = 0.9; // to swing

// How far it is shut, by the tangent of half its angle: a turn without sines, about as even.
rt_transform swung(const rt_transform& rest, double side, double closed) {
    constexpr double kTan45Half = 0.41421356237309503;
    const double t = kTan45Half * closed, scale = 1 / (1 + t * t);
    return turned(rest, side * 2 * t * scale, (1 - t * t) * scale);
}

} // namespace

Door::Door(const Part& part) : mover_(part), side_(part.rest.m[0] > 0 ? -1 : 1) {
    hinge_ = placed(part.rest, Vec3(0));
    middle_ = placed(swung(part.rest, side_, 1), 0.5 * (part.lower + part.upper));
}

void Door::update(const rt_api& api, rt_scene scene, bool blocked,
                  std::vector<gameplay::MeshMotion>& motions) {
    if (blocked && is_closing()) goal_ = 0;
    const double step = kTick / kSeconds;
    closed_ += std::clamp(goal_ - closed_, -step, step);
    mover_.move(api, scene, swung(mover_.part().rest, side_, closed_), motions);
}

void Door::add_to(gameplay::StateHash& hash) const {
    hash.add(closed_);
    hash.add(goal_);
}

} // namespace peregrine::three_cores
