#pragma once

#include "gameplay/three_cores/mover.h"

namespace peregrine::three_cores {

// A lift or a gate: goes straight from where it rests to another place and back, gently at both
// ends.
class Platform {
public:
    Platform(const Part& part, const Vec3& way, double seconds)
        : mover_(part), way_(way), step_(1 / seconds) {}

    void update(const rt_api& api, rt_scene scene, std::vector<gameplay::MeshMotion>& motions);
    void set_goal(double goal) { goal_ = goal; } // 0: rest, 1: the other end

    double goal() const { return goal_; }
    bool is_moving() const { return at_ != goal_; }
    bool carries(const rt_mesh& mesh) const { return mover_.has(mesh); }
    const rt_transform& place() const { return mover_.place(); }
    void add_to(gameplay::StateHash& hash) const;

private:
    Mover mover_;
    Vec3 way_;
    double step_; // a second
    double at_ = 0, goal_ = 0;
};

} // namespace peregrine::three_cores
