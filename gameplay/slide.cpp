#include "gameplay/slide.h"

#include "gameplay/planes.h"
#include "gameplay/step.h"

#include <glm/geometric.hpp>

namespace peregrine::gameplay {
namespace {

constexpr int kMostTouches = 8;
constexpr double kLeastMotion = 1e-6; // metres

Vec3 horizontal(const Vec3& v) {
    return {v.x, 0, v.z};
}

// Slopes that are too steep to stand on turn no horizontal motion into height.
Vec3 stop_at_steep(const Body& body, const Vec3& motion, const Vec3& normal) {
    const Vec3 wall = horizontal(normal);
    const double into = glm::dot(motion, wall);
    if (normal.y <= 0 || body.is_walkable(normal) || into >= 0) return motion;
    return motion - wall * (into / glm::dot(wall, wall));
}

// The motion in x and z with the height that the plane gives it.
Vec3 along(const Vec3& motion, const Vec3& plane) {
    return {motion.x, -(plane.x * motion.x + plane.z * motion.z) / plane.y, motion.z};
}

// A wall as it holds back motion along a ground plane: n . along(m, ground) = wall . m.
Vec3 wall_on(const Vec3& normal, const Vec3& ground) {
    return horizontal(normal) - horizontal(ground) * (normal.y / ground.y);
}

} // namespace

void slide_in_air(const Body& body, Vec3& position, Vec3& velocity, Vec3 motion) {
    Planes planes;
    for (int i = 0; i < kMostTouches && glm::length(motion) > kLeastMotion; ++i) {
        const auto touch = body.advance(position, motion);
        if (!touch) return;
        planes.add(touch->normal);
        motion = planes.clip(stop_at_steep(body, motion * (1 - touch->travelled), touch->normal));
        velocity = planes.clip(stop_at_steep(body, velocity, touch->normal));
    }
}

bool slide_on_ground(const Body& body, Vec3& position, Vec3 ground, Vec3 motion) {
    const Vec3 wanted = motion;
    Planes walls;
    bool free = true;
    for (int i = 0; i < kMostTouches && glm::length(motion) > kLeastMotion; ++i) {
        const auto touch = body.advance(position, along(motion, ground));
        if (!touch) return free;
        motion *= 1 - touch->travelled;
        if (body.is_walkable(touch->normal)) {
            ground = touch->normal;
            continue;
        }
        if (climb_step(body, ground, position, motion)) continue;
        free = false;
        const Vec3 wall = wall_on(touch->normal, ground);
        const double steepness = glm::length(wall);
        if (steepness < 1e-6) return false;
        walls.add(wall / steepness);
        motion = horizontal(walls.clip(motion));
        if (glm::dot(motion, wanted) <= 0) return false; // no way out of a corner but back
    }
    return false;
}

} // namespace peregrine::gameplay
