#pragma once

#include "level.h"
#include "probe.h"

namespace host {

// What the player asks for, for the next step.
struct Controls {
    float forward = 0.0f, right = 0.0f, up = 0.0f; // -1 to 1
    bool run = false;
    glm::vec2 turn{0.0f}; // radians: to the left, upwards
};

// A person who looks and moves: flying through everything, or walking on floors and stopped by
// walls.
class Walker {
  public:
    explicit Walker(const Probe& probe) : m_probe(probe) {}

    void place(const Viewpoint& viewpoint);
    void toggle_walking();
    bool walking() const { return m_walking; }

    void step(const Controls& controls, double seconds);

    Viewpoint viewpoint() const;

  private:
    glm::dvec3 forward() const;
    void fly(const Controls& controls, double seconds);
    void walk(const Controls& controls, double seconds);
    glm::dvec3 slide_along_walls(glm::dvec3 motion) const;
    void settle_on_floor(double seconds);

    const Probe& m_probe;
    glm::dvec3 m_eye{0.0};
    double m_yaw = 0.0, m_pitch = 0.0; // yaw 0 looks along -Z and grows to the left
    double m_fall_speed = 0.0;
    float m_vertical_fov = 1.0471976f;
    bool m_walking = false;
};

} // namespace host
