#pragma once

#include "gameplay/three_cores/mover.h"

namespace peregrine::three_cores {

// A box that a blast pushes over the floor. It slides upright, stops at what it meets and falls
// where there is no floor.
class Crate {
public:
    explicit Crate(const Part& part);

    void push(const Vec3& velocity) { velocity_ += velocity; }
    void update(const rt_api& api, rt_scene scene, const gameplay::World& world,
                std::vector<gameplay::MeshMotion>& motions);

    Vec3 middle() const { return box_.center + offset_; }
    void add_to(gameplay::StateHash& hash) const;

private:
    bool fits(const gameplay::World& world, const Vec3& offset) const;

    Mover mover_;
    gameplay::Box box_; // at rest
    Vec3 offset_{0}, velocity_{0};
};

} // namespace peregrine::three_cores
