#pragma once

#include "gameplay/three_cores/platform.h"

namespace peregrine::three_cores {

// A platform that sets out a moment after somebody stepped on it, comes when it is called, and goes
// back to where it rests when nobody has used it for a while.
class Lift {
public:
    explicit Lift(const LiftPlan& lift);

    // True in the tick that it sets out in.
    bool update(const rt_api& api, rt_scene scene, const gameplay::CharacterState& rider,
                std::vector<gameplay::MeshMotion>& motions);
    // True if it comes: somebody stands in its way up or down, or beside it.
    bool call(const Vec3& feet, double reach);
    bool can_call(const Vec3& feet, double reach) const;

    Vec3 place() const { return placed(platform_.place(), Vec3(0)); }
    const Vec3& bottom() const { return bottom_; }
    const Vec3& top() const { return top_; }
    bool is_moving() const { return platform_.is_moving(); }
    void add_to(gameplay::StateHash& hash) const;

private:
    Platform platform_;
    Vec3 bottom_, top_;
    double standing_ = 0; // seconds that somebody has stood on it since it stopped
    double alone_ = 0;    // seconds that it has waited away from where it rests
};

} // namespace peregrine::three_cores
