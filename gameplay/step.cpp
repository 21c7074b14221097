#include "gameplay/step.h"

#include "gameplay/ground.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace peregrine::gameplay {
namespace {

constexpr double kLeastStep = 0.4;                // radii; carries over ridges that carry nobody
constexpr double kLeastProgress = 1e-4;           // metres
constexpr double kTolerance = 1e-3;               // metres, of the height of a step
constexpr double kLifts[] = {1, 0.75, 0.5, 0.25}; // of the room above, tried in turn

// How much higher a slope is at the front of the body than below its middle.
double rise_ahead(const Vec3& ground, const Vec3& motion, double radius) {
    const double slope = -(ground.x * motion.x + ground.z * motion.z) / ground.y;
    return std::max(slope / glm::length(motion) * radius, 0.0);
}

//            2
//         .----->.
//        1|      |3      up, on, down; it must end on ground that carries
//         |   ___v____
//         |  |
//     ____|__|
struct Step {
    Ground top;
    double travelled; // fraction of the motion
};

enum class Outcome { climbed, blocked, no_ground };

Outcome try_step(const Body& body, const Vec3& position, const Vec3& raised, const Vec3& motion,
                 double height, Step& step) {
    Vec3 moved = raised;
    const auto touch = body.advance(moved, motion);
    step.travelled = touch ? touch->travelled : 1;
    if (step.travelled * glm::length(motion) < kLeastProgress) return Outcome::blocked;
    const auto top = find_ground(body, moved, raised.y - position.y);
    // An edge that the round end rolls over lies higher than the body's lowest point.
    if (!top || top->point.y - position.y > height + kTolerance || top->position.y < position.y)
        return touch ? Outcome::blocked : Outcome::no_ground;
    step.top = *top;
    return Outcome::climbed;
}

} // namespace

bool climb_step(const Body& body, const Vec3& ground, Vec3& position, Vec3& motion) {
    const CharacterRules& rules = body.rules();
    const double length = glm::length(motion);
    if (length < kLeastProgress) return false;
    const double height = rules.step_height + rise_ahead(ground, motion, rules.radius);
    Vec3 raised = position;
    body.advance(raised, Vec3(0, height + 2 * rules.skin, 0));
    if (raised.y - position.y < kLeastProgress) return false;

    Step step;
    Outcome outcome = Outcome::blocked;
    for (const double lift : kLifts) { // lower ones for what hangs over the step
        const Vec3 lifted(position.x, glm::mix(position.y, raised.y, lift), position.z);
        outcome = try_step(body, position, lifted, motion, height, step);
        if (outcome != Outcome::blocked) break;
    }
    const double least = kLeastStep * rules.radius;
    if (outcome == Outcome::no_ground && length < least) // a sharp ridge, met slowly
        outcome = try_step(body, position, raised, motion * (least / length), height, step);
    if (outcome != Outcome::climbed) return false;
    position = step.top.position;
    motion *= 1 - step.travelled;
    return true;
}

} // namespace peregrine::gameplay
