#include "gameplay/three_cores/start.h"

#include "gameplay/three_cores/rules.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::three_cores {
namespace {

constexpr gameplay::Mask kWalls{kSolid, {}};
constexpr size_t kFar = 3000;             // places: 750 square metres
constexpr size_t kFloods = 12;            // at most
constexpr size_t kStoreys = 12;           // of a column, at most
constexpr double kBelow = 0.01;           // metres
constexpr size_t kAround = 30;            // places
constexpr double kWaist = 1.2, kDrop = 5; // metres
constexpr double kSkyward = 100;          // metres

struct Region {
    Floors floors;
    Spawn spawn;
    double worth; // places; those under a roof count twice
};

class Search {
public:
    explicit Search(const gameplay::World& world) : world_(world) {}

    // Returns whether there is no better place to be expected.
    bool consider(const Spawn& spawn, bool roofs_count) {
        if (regions_.size() >= kFloods) return true;
        const Vec3 low = spawn.feet + Vec3(0, 0.3, 0);
        for (const Region& region : regions_)
            if (region.floors.nearest(low, Floors::kCell) != Floors::kNone) return false;
        Region region{Floors(world_, walker(), kWalls), spawn, 0};
        const uint32_t node = region.floors.explore(spawn.feet, kFar);
        if (node == Floors::kNone) return false;
        region.worth = double(std::min(region.floors.size(), kFar));
        if (roofs_count && is_roofed(region.spawn.feet)) region.worth *= 2;
        regions_.push_back(std::move(region));
        return regions_.back().worth >= double(roofs_count ? 2 * kFar : kFar);
    }

    std::optional<Spawn> best(size_t least) const {
        const auto best = std::ranges::max_element(regions_, {}, &Region::worth);
        if (best == regions_.end() || best->floors.size() < least) return std::nullopt;
        return best->spawn;
    }

private:
    bool is_roofed(const Vec3& feet) const {
        const Vec3 head = feet + Vec3(0, walker().height, 0);
        return !world_.is_free(head, head + Vec3(0, kSkyward, 0), kWalls);
    }

    gameplay::World world_;
    std::vector<Region> regions_;
};

bool fits(const gameplay::World& world, const Vec3& feet) {
    const gameplay::CharacterRules body = walker();
    const double lift = 2 * body.skin, half = 0.5 * body.height;
    return !world.overlaps(
        {feet + Vec3(0, half + lift, 0), body.radius + body.skin, Vec3(0, half - body.radius, 0)},
        kWalls);
}

// The floor at a place that may be a little off: in it, or above it by less than a person.
std::optional<Vec3> settle(const gameplay::World& world, const Vec3& feet) {
    const auto floor = world.closest(feet + Vec3(0, kWaist, 0), {0, -kDrop, 0}, kWalls);
    if (!floor) return std::nullopt;
    if (fits(world, floor->point)) return floor->point;
    Floors floors(world, walker(), kWalls);
    floors.explore(floor->point, kAround);
    for (uint32_t node = 0; node < floors.size(); ++node)
        if (fits(world, floors.place(node))) return floors.place(node);
    return std::nullopt;
}

// Where the view is longest, of eight ways.
Vec3 longest_view(const gameplay::World& world, const Vec3& feet) {
    constexpr double kDiagonal = 0.70710678118654752;
    const Vec3 eye = feet + Vec3(0, walker().height - 0.1, 0);
    Vec3 best(0, 0, -1);
    double longest = -1;
    for (const Vec3& way : {Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0),
                            Vec3(kDiagonal, 0, -kDiagonal), Vec3(kDiagonal, 0, kDiagonal),
                            Vec3(-kDiagonal, 0, kDiagonal), Vec3(-kDiagonal, 0, -kDiagonal)}) {
        const auto hit = world.closest(eye, kSkyward * way, kWalls);
        const double length = hit ? hit->t : 1;
        if (length <= longest) continue;
        longest = length;
        best = way;
    }
    return best;
}

// The floors of a column, from above.
std::vector<Vec3> storeys(const Plan& plan, const gameplay::World& world, double x, double z) {
    std::vector<Vec3> floors;
    double top = plan.upper.y + 1;
    const double bottom = plan.lower.y - 1;
    for (size_t i = 0; i < kStoreys && top > bottom; ++i) {
        const auto hit = world.closest({x, top, z}, {0, bottom - top, 0}, kWalls);
        if (!hit) break;
        floors.push_back(hit->point);
        top = hit->point.y - kBelow;
    }
    return floors;
}

// The cells of a grid over the level, from the middle outwards.
std::vector<Vec3> grid(const Plan& plan, int half) {
    std::vector<std::pair<int, Vec3>> places;
    const Vec3 middle = 0.5 * (plan.lower + plan.upper);
    const Vec3 cell = (plan.upper - plan.lower) / double(2 * half + 1);
    for (int i = -half; i <= half; ++i)
        for (int k = -half; k <= half; ++k)
            places.emplace_back(i * i + k * k, middle + Vec3(i * cell.x, 0, k * cell.z));
    std::ranges::stable_sort(places, {}, &std::pair<int, Vec3>::first);
    std::vector<Vec3> sorted;
    for (const auto& [distance, place] : places) sorted.push_back(place);
    return sorted;
}

} // namespace

gameplay::CharacterRules walker() {
    return rules_of(Difficulty::normal).character;
}

void settle_spawns(Plan& plan, const gameplay::World& world) {
    std::vector<Spawn> settled;
    for (Spawn spawn : plan.spawns) {
        const auto feet = settle(world, spawn.feet);
        if (!feet) continue;
        spawn.feet = *feet;
        settled.push_back(spawn);
    }
    plan.spawns = std::move(settled);
}

std::optional<Spawn> choose_spawn(const Plan& plan, const gameplay::World& world) {
    Search search(world);
    for (const Spawn& spawn : plan.spawns)
        if (search.consider(spawn, false)) break;
    return search.best(kFewPlaces);
}

std::optional<Spawn> find_spawn(const Plan& plan, const gameplay::World& world) {
    for (const int half : {4, 16}) {
        Search search(world);
        bool done = false;
        for (const Vec3& place : grid(plan, half)) {
            for (const Vec3& floor : storeys(plan, world, place.x, place.z))
                if (const auto feet = settle(world, floor))
                    done = done || search.consider({*feet}, true);
            if (done) break;
        }
        std::optional<Spawn> spawn = search.best(1);
        if (!spawn) continue;
        spawn->forward = longest_view(world, spawn->feet);
        return spawn;
    }
    return std::nullopt;
}

} // namespace peregrine::three_cores
