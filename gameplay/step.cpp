#include "gameplay/step.h"

#include "gameplay/ground.h"

#include <glm/geometric.hpp>

namespace peregrine::gameplay {
namespace {

constexpr double kLeastProgress = 1e-4; // metres
constexpr double kTolerance = 1e-3;     // metres, of the height of a step

} // namespace

//            2
//         .----->.
//        1|      |3      up, on, down; it must end on ground that carries
//         |   ___v____
//         |  |
//     ____|__|
bool climb_step(const Body& body, Vec3& position, Vec3& motion) {
    const CharacterRules& rules = body.rules();
    Vec3 moved = position;
    body.advance(moved, Vec3(0, rules.step_height + 2 * rules.skin, 0));
    const double raised = moved.y - position.y;
    if (raised < kLeastProgress) return false;

    const double length = glm::length(motion);
    const auto touch = body.advance(moved, motion);
    const double travelled = touch ? touch->travelled : 1;
    if (travelled * length < kLeastProgress) return false;

    // An edge that the round end rolls over lies higher than the body's lowest point.
    const auto ground = find_ground(body, moved, raised);
    if (!ground || ground->point.y - position.y > rules.step_height + kTolerance) return false;
    if (ground->position.y < position.y) return false;
    position = ground->position;
    motion *= 1 - travelled;
    return true;
}

} // namespace peregrine::gameplay
