#include "support/floor_graph.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace peregrine::test {
namespace {

constexpr double kCell = 0.5;       // metres
constexpr double kSameFloor = 0.15; // metres: heights of one point
constexpr double kWalkable = 0.7;   // cosine, a little flatter than the character's limit
constexpr int kSamples = 5;         // of the floor between two points

} // namespace

std::optional<double> FloorGraph::floor_at(double x, double z, double y) const {
    const double above = rules_.step_height;
    const auto hit = world_.closest({x, y + above, z}, {0, -2.5 * above, 0});
    if (!hit || hit->normal.y < kWalkable) return std::nullopt;
    return hit->point.y;
}

// What must fit: from the height of a step upwards, and a tenth wider than the body.
gameplay::Capsule FloorGraph::torso(const Vec3& place) const {
    const double radius = 1.1 * rules_.radius;
    const double low = rules_.step_height + 0.01 + radius, high = rules_.height - radius + 0.02;
    return {place + Vec3(0, 0.5 * (low + high), 0), radius, Vec3(0, 0.5 * (high - low), 0)};
}

//        |  |
//        (__)      the torso's lower end is round: a star of bars covers what it leaves out
//      --------
//     ___________
bool FloorGraph::has_room(const Vec3& place) const {
    if (world_.overlaps(torso(place))) return false;
    const double thickness = 0.05, reach = rules_.radius - thickness;
    const Vec3 center = place + Vec3(0, rules_.step_height + thickness, 0);
    for (const Vec3& bar : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.7, 0, 0.7), Vec3(0.7, 0, -0.7)})
        if (world_.overlaps({center, thickness, reach * bar})) return false;
    return true;
}

bool FloorGraph::can_go(const Vec3& from, const Vec3& to) const {
    double height = from.y;
    for (int i = 1; i <= kSamples; ++i) {
        const Vec3 place = glm::mix(from, to, double(i) / kSamples);
        const auto floor = floor_at(place.x, place.z, height);
        if (!floor || std::fabs(*floor - height) > 0.95 * rules_.step_height) return false;
        height = *floor;
    }
    const double level = std::hypot(to.x - from.x, to.z - from.z);
    return std::fabs(height - to.y) < kSameFloor && std::fabs(to.y - from.y) < level
           && !world_.sweep(torso(from), to - from, {}, false);
}

uint32_t FloorGraph::node_at(const Cell& cell, const Vec3& position) {
    for (const uint32_t node : cells_[cell])
        if (std::fabs(nodes_[node].position.y - position.y) < kSameFloor) return node;
    nodes_.push_back({position, cell, {}});
    cells_[cell].push_back(uint32_t(nodes_.size() - 1));
    return uint32_t(nodes_.size() - 1);
}

std::optional<uint32_t> FloorGraph::find(const Vec3& place) const {
    const Cell cell{int(std::lround(place.x / kCell)), int(std::lround(place.z / kCell))};
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return std::nullopt;
    for (const uint32_t node : found->second)
        if (std::fabs(nodes_[node].position.y - place.y) < kSameFloor) return node;
    return std::nullopt;
}

std::optional<uint32_t> FloorGraph::explore(const Vec3& place, size_t most) {
    const Cell cell{int(std::lround(place.x / kCell)), int(std::lround(place.z / kCell))};
    const Vec3 top(kCell * cell.first, place.y, kCell * cell.second);
    const auto below = world_.closest(top, {0, -4, 0});
    if (!below || below->normal.y < kWalkable || !has_room(below->point)) return std::nullopt;
    const size_t before = nodes_.size();
    const uint32_t first = node_at(cell, below->point);
    if (nodes_.size() == before) return first;

    for (size_t i = first; i < nodes_.size() && nodes_.size() < before + most; ++i)
        for (int dx = -1; dx <= 1; ++dx)
            for (int dz = -1; dz <= 1; ++dz) {
                if (dx == 0 && dz == 0) continue;
                const Vec3 from = nodes_[i].position;
                const Cell next{nodes_[i].cell.first + dx, nodes_[i].cell.second + dz};
                const double x = kCell * next.first, z = kCell * next.second;
                // On a slope the next floor may lie up to a cell higher or lower.
                for (const double rise : {0.0, 0.4, -0.4}) {
                    const auto floor = floor_at(x, z, from.y + rise);
                    if (!floor || !has_room({x, *floor, z}) || !can_go(from, {x, *floor, z}))
                        continue;
                    const uint32_t to = node_at(next, {x, *floor, z});
                    nodes_[i].links.push_back(to);
                    break;
                }
            }
    return first;
}

FloorGraph::Tree FloorGraph::search(uint32_t from) const {
    Tree tree{{from}, std::vector<int64_t>(nodes_.size(), -1)};
    tree.parents[from] = from;
    for (size_t i = 0; i < tree.order.size(); ++i)
        for (const uint32_t next : nodes_[tree.order[i]].links)
            if (tree.parents[next] < 0) {
                tree.parents[next] = tree.order[i];
                tree.order.push_back(next);
            }
    return tree;
}

std::vector<uint32_t> FloorGraph::reached_from(uint32_t from) const {
    return search(from).order;
}

std::vector<uint32_t> FloorGraph::path(uint32_t from, uint32_t to) const {
    const Tree tree = search(from);
    if (tree.parents[to] < 0) return {};
    std::vector<uint32_t> way{to};
    while (way.back() != from) way.push_back(uint32_t(tree.parents[way.back()]));
    std::reverse(way.begin(), way.end());
    return way;
}

} // namespace peregrine::test
