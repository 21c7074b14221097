#include "gameplay/three_cores/platform.h"

#include "gameplay/three_cores/rules.h"

#include <algorithm>

namespace peregrine::three_cores {

void Platform::update(const rt_api& api, rt_scene scene,
                      std::vector<gameplay::MeshMotion>& motions) {
    const double step = kTick * step_;
    at_ += std::clamp(goal_ - at_, -step, step);
    const double eased = at_ * at_ * (3 - 2 * at_);
    mover_.move(api, scene, shifted(mover_.part().rest, eased * way_), motions);
}

void Platform::add_to(gameplay::StateHash& hash) const {
    hash.add(at_);
    hash.add(goal_);
}

} // namespace peregrine::three_cores
