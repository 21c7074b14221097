#pragma once

#include "gameplay/three_cores/mover.h"

namespace peregrine::three_cores {

// A leaf that swings between open, as it rests, and closed: a quarter of a turn about its own Y
// axis, to where its X axis points along the world's +Z.
class Door {
public:
    explicit Door(const Part& part);

    // A tick; `blocked` turns a leaf back that closes on somebody.
    void update(const rt_api& api, rt_scene scene, bool blocked,
                std::vector<gameplay::MeshMotion>& motions);
    void set_open(bool open) { goal_ = open ? 0 : 1; }

    bool is_open() const { return goal_ == 0; }
    bool is_closing() const { return goal_ > closed_; }
    const Vec3& hinge() const { return hinge_; }
    const Vec3& middle() const { return middle_; } // of the closed leaf
    void add_to(gameplay::StateHash& hash) const;

private:
    Mover mover_;
    Vec3 hinge_, middle_;
    double side_;       // which way it turns
    double closed_ = 1; // 0: open, 1: closed
    double goal_ = 1;
};

} // namespace peregrine::three_cores
