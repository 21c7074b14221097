#include "gameplay/step.h"

#include "gameplay/ground.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr double kLeastProgress = 1e-4; // metres
constexpr double kTolerance = 1e-3;     // metres, of the height of a step

// How much higher a slope is at the front of the body than below its middle.
double rise_ahead(const Vec3& ground, const Vec3& motion, double radius) {
    const double slope = -(ground.x * motion.x + ground.z * motion.z) / ground.y;
    return std::max(slope / glm::length(motion) * radius, 0.0);
}

} // namespace

//            2
//         .----->.
//        1|      |3      up, on, down; it must end on ground that carries
//         |   ___v____
//         |  |
//     ____|__|
bool climb_step(const Body& body, const Vec3& ground, Vec3& position, Vec3& motion) {
    const CharacterRules& rules = body.rules();
    const double length = glm::length(motion);
    if (length < kLeastProgress) return false;
    const double height = rules.step_height + rise_ahead(ground, motion, rules.radius);
    Vec3 moved = position;
    body.advance(moved, Vec3(0, height + 2 * rules.skin, 0));
    const double raised = moved.y - position.y;
    if (raised < kLeastProgress) return false;

    const auto touch = body.advance(moved, motion);
    const double travelled = touch ? touch->travelled : 1;
    if (travelled * length < kLeastProgress) return false;

    // An edge that the round end rolls over lies higher than the body's lowest point.
    const auto top = find_ground(body, moved, raised);
    if (!top || top->point.y - position.y > height + kTolerance) return false;
    if (top->position.y < position.y) return false;
    position = top->position;
    motion *= 1 - travelled;
    return true;
}

} // namespace peregrine::gameplay
