#pragma once

#include "level.h"
#include "probe.h"

namespace host {

// What the player asks for, for the next step.
struct Controls {
    float forward = 0.0f, right = 0.0f, up = 0.0f; // -1 to 1
    bool run = false;
    glm::vec2 turn{0.0f};      // radians: to the left, upwards
    glm::vec2 turn_rate{0.0f}; // the same in radians a second

    bool idle() const {
        return forward == 0.0f && right == 0.0f && up == 0.0f && turn == glm::vec2(0.0f)
               && turn_rate == glm::vec2(0.0f);
    }
};

// A person who looks and moves: flying through everything, or walking on floors and stopped by
// walls.
class Walker {
public:
    explicit Walker(const Probe& probe) : probe_(probe) {}

    void place(const Viewpoint& viewpoint);
    void toggle_walking();
    bool walking() const { return walking_; }

    void step(const Controls& controls, double seconds);

    Viewpoint viewpoint() const;

private:
    glm::dvec3 forward() const;
    void fly(const Controls& controls, double seconds);
    void walk(const Controls& controls, double seconds);
    glm::dvec3 slide_along_walls(glm::dvec3 motion) const;
    void settle_on_floor(double seconds);

    const Probe& probe_;
    glm::dvec3 eye_{0.0};
    double yaw_ = 0.0, pitch_ = 0.0; // yaw 0 looks along -Z and grows to the left
    double fall_speed_ = 0.0;
    float vertical_fov_ = 1.0471976f;
    bool walking_ = false;
};

} // namespace host
