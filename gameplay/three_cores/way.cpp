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

bool meets(const Vec3& from, const Vec3& to, const Blocker& box) {
    double first = 0, last = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double start = from[axis], motion = to[axis] - start;
        double a = box.lower[axis] - start, b = box.upper[axis] - start;
        if (motion == 0) {
            if (a > 0 || b < 0) return false;
            continue;
        }
        a /= motion;
        b /= motion;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last;
}

bool is_blocked(const Vec3& from, const Vec3& to, std::span<const Blocker> blockers) {
    return std::any_of(blockers.begin(), blockers.end(),
                       [&](const Blocker& box) { return meets(from, to, box); });
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

std::vector<uint32_t> find_way(const Floors& floors, uint32_t from, uint32_t to,
                               std::span<const Blocker> blockers) {
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
            if (is_blocked(floors.place(node), floors.place(next), blockers)) continue;
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

std::vector<Vec3> find_way(const Floors& floors, const Vec3& from, const Vec3& to,
                           std::span<const Blocker> blockers) {
    std::vector<Vec3> points;
    for (const uint32_t node : find_way(floors, floors.nearest(from), floors.nearest(to), blockers))
        points.push_back(floors.place(node));
    return points;
}

} // namespace peregrine::three_cores
