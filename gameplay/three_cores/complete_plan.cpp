#include "gameplay/three_cores/patrols.h"
#include "gameplay/three_cores/plan.h"
#include "gameplay/three_cores/rules.h"
#include "gameplay/three_cores/start.h"
#include "gameplay/three_cores/way.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::three_cores {
namespace {

constexpr size_t kMostPlaces = 6000; // 1500 square metres
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr size_t kCores = 3;
constexpr double kFarEnough = 80; // metres: a round should take minutes
constexpr size_t kOpen = 8;       // links of a place in the open
constexpr double kCoreHeight = 1; // metres above the floor
constexpr gameplay::Mask kWalls{kSolid, {}};

bool is_complete(const Plan& plan) {
    return !plan.spawns.empty() && !plan.cores.empty() && !plan.patrols.empty()
           && !plan.exits.empty();
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Where to begin goes first. Where one could not get away from nobody begins again.
void order_spawns(Plan& plan, const Spawn& first, const Floors& floors) {
    std::vector<Spawn> spawns{first};
    for (const Spawn& spawn : plan.spawns)
        if (spawn.feet != first.feet && floors.nearest(spawn.feet) != Floors::kNone)
            spawns.push_back(spawn);
    plan.spawns = std::move(spawns);
}

// Distances to what a new place should be far from.
class Spread {
public:
    explicit Spread(const Floors& floors) : floors_(floors), nearest_(floors.size(), kNever) {
        for (uint32_t i = 0; i < floors.size(); ++i)
            open_ = std::clamp(floors.links(i).size(), open_, kOpen);
    }

    void keep_away_from(uint32_t node) {
        const std::vector<double> distances = distances_from(floors_, node);
        for (size_t i = 0; i < nearest_.size(); ++i)
            nearest_[i] = std::min(nearest_[i], distances[i]);
    }

    // The farthest place in the open, or the first that is far enough.
    uint32_t farthest() const {
        uint32_t best = 0;
        double distance = -1;
        for (uint32_t i = 0; i < floors_.size(); ++i) {
            const double away = std::min(nearest_[i], kFarEnough);
            if (floors_.links(i).size() < open_ || away <= distance) continue;
            best = i;
            distance = away;
        }
        return best;
    }

private:
    const Floors& floors_;
    size_t open_ = 0; // links
    std::vector<double> nearest_;
};

void place_cores(Plan& plan, const Floors& floors, uint32_t spawn) {
    Spread spread(floors);
    spread.keep_away_from(spawn);
    for (size_t i = 0; i < kCores; ++i) {
        const uint32_t node = spread.farthest();
        plan.cores.push_back(floors.place(node) + Vec3(0, kCoreHeight, 0));
        spread.keep_away_from(node);
    }
}

void place_exit(Plan& plan, const Floors& floors, uint32_t spawn) {
    Spread spread(floors);
    for (const Vec3& core : plan.cores) spread.keep_away_from(floors.nearest(core));
    if (plan.cores.empty()) spread.keep_away_from(spawn);
    plan.exits.push_back(floors.place(spread.farthest()));
}

} // namespace

void complete_plan(Plan& plan, const gameplay::World& world) {
    if (is_complete(plan)) return;
    if (!is_finite(plan.lower) || !is_finite(plan.upper))
        throw PlanError("the level has no bounds: its corners are not finite");
    settle_spawns(plan, world);
    std::optional<Spawn> start = choose_spawn(plan, world);
    if (!start) start = find_spawn(plan, world);
    if (!start) throw PlanError("there is no floor in the level on which a person could stand");

    Floors floors(world, walker(), kWalls);
    const uint32_t spawn = floors.explore(start->feet, kMostPlaces);
    if (floors.size() < kFewPlaces)
        throw PlanError("the floor that can be reached is too small for three cores");
    order_spawns(plan, *start, floors);
    if (plan.cores.empty()) place_cores(plan, floors, spawn);
    if (plan.exits.empty()) place_exit(plan, floors, spawn);
    if (plan.patrols.empty()) plan.patrols = plan_patrols(world, floors, start->feet);
}

} // namespace peregrine::three_cores
