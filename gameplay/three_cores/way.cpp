#include "gameplay/three_cores/way.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

namespace peregrine::three_cores {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kBesideWalls = 1.25; // a way through the open counts as shorter
constexpr size_t kOpen = 8;           // links of a place in the open

double cost(const Floors& floors, uint32_t from, uint32_t to) {
    const double length = glm::length(floors.place(to) - floors.place(from));
    return floors.links(to).size() < kOpen ? kBesideWalls * length : length;
}

// Of equal costs the place found first goes first.
using Entry = std::pair<double, uint32_t>;
using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

} // namespace

std::vector<double> distances_from(const Floors& floors, uint32_t from) {
    std::vector<double> distances(floors.size(), kNever);
    if (from >= floors.size()) return distances;
    Queue queue;
    distances[from] = 0;
    queue.emplace(0, from);
    while (!queue.empty()) {
        const auto [distance, node] = queue.top();
        queue.pop();
        if (distance > distances[node]) continue;
        for (const uint32_t next : floors.links(node)) {
            const double sum = distance + cost(floors, node, next);
            if (sum >= distances[next]) continue;
            distances[next] = sum;
            queue.emplace(sum, next);
        }
    }
    return distances;
}

std::vector<uint32_t> find_way(const Floors& floors, uint32_t from, uint32_t to) {
    if (from >= floors.size() || to >= floors.size()) return {};
    std::vector<double> distances(floors.size(), kNever);
    std::vector<uint32_t> parents(floors.size(), Floors::kNone);
    std::vector<uint8_t> done(floors.size(), 0);
    Queue queue;
    distances[from] = 0;
    queue.emplace(0, from);
    while (!queue.empty() && !done[to]) {
        const uint32_t node = queue.top().second;
        queue.pop();
        if (done[node]) continue;
        done[node] = 1;
        for (const uint32_t next : floors.links(node)) {
            const double sum = distances[node] + cost(floors, node, next);
            if (sum >= distances[next]) continue;
            distances[next] = sum;
            parents[next] = node;
            queue.emplace(sum + glm::length(floors.place(to) - floors.place(next)), next);
        }
    }
    if (!done[to]) return {};
    std::vector<uint32_t> way{to};
    while (way.back() != from) way.push_back(parents[way.back()]);
    std::reverse(way.begin(), way.end());
    return way;
}

std::vector<Vec3> find_way(const Floors& floors, const Vec3& from, const Vec3& to) {
    std::vector<Vec3> points;
    for (const uint32_t node : find_way(floors, floors.nearest(from), floors.nearest(to)))
        points.push_back(floors.place(node));
    return points;
}

} // namespace peregrine::three_cores
