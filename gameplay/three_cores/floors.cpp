#include "gameplay/three_cores/floors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::three_cores {
namespace {

constexpr double kWalkable = 0.7; // cosine, a little flatter than the character's limit
constexpr double kFarthest = 1e6; // cells from the origin
constexpr double kRise = 0.4;     // metres: how far a slope rises over a cell beyond a step
constexpr double kSame = 0.001;   // metres: heights of one floor
constexpr double kFlat = 0.05;    // metres: lower than what is a step
constexpr int kQuarters = 4;      // a link's floor is looked at after each
constexpr double kReachDown = 4;  // metres
constexpr double kBelow = 0.6, kAbove = 2.2; // metres: what a place stands for
constexpr double kChest = 1.2;               // metres

constexpr int kDirections[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                   {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

uint8_t bit(uint32_t direction) {
    return uint8_t(1u << (direction % 8));
}

uint64_t key(int32_t x, int32_t z) {
    return uint64_t(uint32_t(x)) << 32 | uint32_t(z);
}

// The cell; nothing for a place beyond all levels.
std::optional<std::pair<int32_t, int32_t>> cell_of(const Vec3& place) {
    const double x = std::floor(place.x / Floors::kCell + 0.5);
    const double z = std::floor(place.z / Floors::kCell + 0.5);
    if (!(std::fabs(x) < kFarthest && std::fabs(z) < kFarthest)) return std::nullopt;
    return std::pair(int32_t(x), int32_t(z));
}

Vec3 in_cell(int32_t x, int32_t z, double height) {
    return {Floors::kCell * x, height, Floors::kCell * z};
}

double level_distance(const Vec3& a, const Vec3& b) {
    const double x = b.x - a.x, z = b.z - a.z;
    return std::sqrt(x * x + z * z);
}

} // namespace

Floors::Floors(const gameplay::World& world, const gameplay::CharacterRules& rules,
               const gameplay::Mask& mask)
    : world_(world), rules_(rules), layers_(mask.layers),
      ignored_(mask.ignored.begin(), mask.ignored.end()) {}

std::optional<double> Floors::height_at(double x, double z, double height) const {
    const double above = rules_.step_height;
    const auto hit = world_.closest({x, height + above, z}, {0, -2.5 * above, 0}, mask());
    if (!hit || hit->normal.y < kWalkable) return std::nullopt;
    return hit->point.y;
}

// What must fit: from the height of a step upwards, and a tenth wider than the body.
gameplay::Capsule Floors::torso(const Vec3& place) const {
    const double radius = 1.1 * rules_.radius;
    const double low = rules_.step_height + 0.01 + radius, high = rules_.height - radius + 0.02;
    return {place + Vec3(0, 0.5 * (low + high), 0), radius, Vec3(0, 0.5 * (high - low), 0)};
}

// The torso's lower end is round: a star of bars covers what it leaves out above a step.
bool Floors::has_room(const Vec3& place) const {
    if (world_.overlaps(torso(place), mask())) return false;
    const double thickness = 0.05, reach = rules_.radius - thickness;
    const Vec3 center = place + Vec3(0, rules_.step_height + thickness, 0);
    for (const Vec3& bar : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.7, 0, 0.7), Vec3(0.7, 0, -0.7)})
        if (world_.overlaps({center, thickness, reach * bar}, mask())) return false;
    return true;
}

bool Floors::can_go(const Vec3& from, const Vec3& to) const {
    const double step = 0.95 * rules_.step_height;
    if (std::fabs(to.y - from.y) >= level_distance(from, to)) return false;
    double height = from.y;
    for (int i = 1; i < kQuarters; ++i) {
        const Vec3 place = from + (to - from) * (double(i) / kQuarters);
        const auto floor = height_at(place.x, place.z, height);
        if (!floor || std::fabs(*floor - height) > step) return false;
        height = *floor;
    }
    if (std::fabs(height - to.y) > step || world_.sweep(torso(from), to - from, mask(), false))
        return false;
    return std::fabs(to.y - from.y) < kFlat || has_headroom(from, to);
}

// Who climbs a step lifts the whole body by the height of the highest one first.
bool Floors::has_headroom(const Vec3& from, const Vec3& to) const {
    const double radius = 1.1 * rules_.radius;
    const double rise = rules_.height + rules_.step_height - radius + std::min(from.y, to.y);
    const Vec3 head(from.x, rise, from.z);
    return !world_.sweep({head, radius}, {to.x - from.x, 0, to.z - from.z}, mask(), false);
}

// The floor of the cell that is seen from a height; null if there is none.
Floors::Level* Floors::level_from(int32_t x, int32_t z, double height) {
    std::vector<Level>& column = columns_[key(x, z)];
    for (Level& level : column) // where there is room no other floor is near
        if (level.has_room && std::fabs(level.height - height) <= rules_.step_height) return &level;
    const auto floor = height_at(kCell * x, kCell * z, height);
    if (!floor) return nullptr;
    for (Level& level : column)
        if (std::fabs(level.height - *floor) <= kSame) return &level;
    column.push_back({*floor, has_room(in_cell(x, z, *floor)), kNone});
    return &column.back();
}

uint32_t Floors::node_of(Level& level, int32_t x, int32_t z) {
    if (level.node == kNone) {
        level.node = uint32_t(nodes_.size());
        nodes_.push_back({in_cell(x, z, level.height), x, z, {}, 0});
    }
    return level.node;
}

void Floors::try_direction(uint32_t node, uint32_t direction) {
    const Vec3 from = nodes_[node].place;
    const int32_t x = nodes_[node].x + kDirections[direction][0];
    const int32_t z = nodes_[node].z + kDirections[direction][1];
    std::optional<double> last;
    for (const double rise : {0.0, kRise, -kRise}) {
        Level* level = level_from(x, z, from.y + rise);
        if (!level || level->height == last) continue;
        last = level->height;
        if (!level->has_room || !can_go(from, in_cell(x, z, level->height))) continue;
        const uint32_t to = node_of(*level, x, z);
        link(node, to);
        link(to, node);
        nodes_[to].tried |= bit(direction + 4);
        return;
    }
}

// The cell under the place or one beside it, whichever has room.
uint32_t Floors::stand(const Vec3& place) {
    const auto cell = cell_of(place);
    const auto floor =
        world_.closest(place + Vec3(0, 0.5 * rules_.step_height, 0), {0, -kReachDown, 0}, mask());
    if (!cell || !floor || floor->normal.y < kWalkable) return kNone;
    Level* best = nullptr;
    int32_t best_x = 0, best_z = 0;
    double best_distance = kCell * 2;
    for (int32_t x = cell->first - 1; x <= cell->first + 1; ++x)
        for (int32_t z = cell->second - 1; z <= cell->second + 1; ++z) {
            const Vec3 there = in_cell(x, z, floor->point.y);
            const double distance = level_distance(place, there);
            if (distance >= best_distance || !can_see(floor->point, there)) continue;
            Level* level = level_from(x, z, floor->point.y);
            if (!level || !level->has_room) continue;
            best = level;
            best_x = x;
            best_z = z;
            best_distance = distance;
        }
    return best ? node_of(*best, best_x, best_z) : kNone;
}

uint32_t Floors::explore(const Vec3& place, size_t most) {
    const uint32_t first = stand(place);
    for (; done_ < nodes_.size() && nodes_.size() < most; ++done_)
        for (uint32_t direction = 0; direction < 8; ++direction)
            if (!(nodes_[done_].tried & bit(direction))) try_direction(uint32_t(done_), direction);
    return first;
}

void Floors::link(uint32_t a, uint32_t b) {
    std::vector<uint32_t>& links = nodes_[a].links;
    if (std::find(links.begin(), links.end(), b) == links.end()) links.push_back(b);
}

bool Floors::can_see(const Vec3& from, const Vec3& floor) const {
    const Vec3 eye(from.x, std::max(from.y, floor.y + rules_.step_height + 0.1), from.z);
    return world_.is_free(eye, floor + Vec3(0, 0.5 * rules_.height, 0), mask());
}

uint32_t Floors::nearest(const Vec3& point, double reach) const {
    const auto cell = cell_of(point);
    if (!cell) return kNone;
    std::vector<std::pair<double, uint32_t>> near; // by distance; a floor that is far below counts
    const int32_t cells = int32_t(reach / kCell) + 1;
    for (int32_t x = cell->first - cells; x <= cell->first + cells; ++x)
        for (int32_t z = cell->second - cells; z <= cell->second + cells; ++z) {
            const auto column = columns_.find(key(x, z));
            if (column == columns_.end()) continue;
            for (const Level& level : column->second) {
                const double above = point.y - level.height;
                if (level.node == kNone || above < -kBelow || above > kAbove) continue;
                const double distance = level_distance(point, nodes_[level.node].place);
                if (distance <= reach)
                    near.emplace_back(distance + std::max(0.0, above - kChest), level.node);
            }
        }
    std::sort(near.begin(), near.end());
    for (const auto& [distance, node] : near)
        if (can_see(point, nodes_[node].place)) return node;
    return near.empty() ? kNone : near.front().second;
}

} // namespace peregrine::three_cores
