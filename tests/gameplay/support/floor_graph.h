#pragma once

#include "gameplay/character.h"

#include <map>
#include <utility>
#include <vector>

namespace peregrine::test {

using gameplay::Vec3;

// Where a person could go from a place: points of the floor on a grid, with links where the floor
// goes on and there is room for a body. Found by rays and by bodies a little too large, without the
// character that is to walk there, and with the narrow places that the game's own floors
// (gameplay/three_cores/floors.h) leave out.
class FloorGraph {
public:
    FloorGraph(const gameplay::World& world, const gameplay::CharacterRules& rules)
        : world_(world), rules_(rules) {}

    // Adds what is reached from the floor below `place`, `most` points at most. Returns the first
    // point, or nothing if nobody can stand there.
    std::optional<uint32_t> explore(const Vec3& place, size_t most);

    size_t size() const { return nodes_.size(); }
    const Vec3& position(uint32_t node) const { return nodes_[node].position; }

    // The shortest way in points, both ends included; empty if there is none.
    std::vector<uint32_t> path(uint32_t from, uint32_t to) const;
    // All that is reached from a point, nearest first.
    std::vector<uint32_t> reached_from(uint32_t from) const;
    // The point that stands for a place, if it is one of the graph's.
    std::optional<uint32_t> find(const Vec3& place) const;

private:
    using Cell = std::pair<int, int>;
    struct Node {
        Vec3 position;
        Cell cell;
        std::vector<uint32_t> links;
    };
    struct Tree { // of a breadth-first search
        std::vector<uint32_t> order;
        std::vector<int64_t> parents; // -1: not reached
    };

    Tree search(uint32_t from) const;
    std::optional<double> floor_at(double x, double z, double y) const;
    bool has_room(const Vec3& place) const;
    bool can_go(const Vec3& from, const Vec3& to) const;
    uint32_t node_at(const Cell& cell, const Vec3& position);
    gameplay::Capsule torso(const Vec3& place) const;

    gameplay::World world_;
    gameplay::CharacterRules rules_;
    std::vector<Node> nodes_;
    std::map<Cell, std::vector<uint32_t>> cells_;
};

} // namespace peregrine::test
