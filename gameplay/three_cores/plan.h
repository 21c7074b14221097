#pragma once

#include "gameplay/world.h"

#include <stdexcept>
#include <vector>

// The level as the game knows it: what moves, what matters, and where.
namespace peregrine::three_cores {

using gameplay::Vec3;

// Rigid meshes that move together.
struct Part {
    std::vector<rt_mesh> meshes;
    rt_transform rest;       // where they stand in the file
    Vec3 lower{0}, upper{0}; // bounds in their own space
};

struct Spawn {
    Vec3 feet{0};
    Vec3 forward{0, 0, -1}; // unit, level
};

// A platform between where it rests and `top`, which is where its origin goes.
struct LiftPlan {
    Part part;
    Vec3 top{0};
};

// What makes the player visible.
struct Lamp {
    enum class Kind { point, spot, sun } kind = Kind::point;
    Vec3 position{0};
    Vec3 direction{0, -1, 0}; // unit; the way its light travels
    double radius = 10;       // infinite: no end
    double candela = 1;       // lux for a sun
    double cos_inner = 1, cos_outer = 0.7;
};

// Of linear RGB (ITU-R BT.709).
inline double luminance(const Vec3& color) {
    return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

// A round whose ends are nearer than this is flown as a loop.
constexpr double kLoopDistance = 9; // metres

struct Plan {
    uint64_t level = 0; // tells levels apart
    std::vector<Spawn> spawns;
    std::vector<Vec3> cores;
    std::vector<std::vector<Vec3>> patrols; // of a drone each
    std::vector<Part> doors;                // leaves; see door.h
    std::vector<Part> crates;
    std::vector<LiftPlan> lifts;
    std::vector<Part> gates; // grilles that rise by their height
    std::vector<Vec3> exits; // on the floor: what to reach in the end
    std::vector<Lamp> lamps;
    Vec3 lower{0}, upper{0}; // of the level
};

// What makes a level unplayable, in a sentence.
class PlanError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Finds places for what the level does not name (cores, patrols, an exit; a spawn, if need be) by
// questions about floors and lines of sight. The scene has to be committed. The same plan for the
// same level, on every machine. Throws PlanError where nobody can stand.
void complete_plan(Plan& plan, const gameplay::World& world);

} // namespace peregrine::three_cores
