#pragma once

#include "gameplay/character.h"

#include <unordered_map>
#include <vector>

namespace peregrine::three_cores {

using gameplay::Vec3;

// Where a person can walk: places of the floor on a grid, each linked to those of the eight around
// it that a step or a slope leads to with room for the body. Nothing is linked that one could not
// walk back, so whatever is reached from a place leads back to it. Found by queries alone, with a
// body a little too large; the same for the same scene, on every machine.
class Floors {
public:
    static constexpr uint32_t kNone = ~0u;
    static constexpr double kCell = 0.5; // metres

    explicit Floors(const gameplay::World& world, const gameplay::CharacterRules& rules,
                    const gameplay::Mask& mask = {});

    // Adds what can be reached from the floor under `place`, nearest first, until there are `most`
    // places in all. Returns the place under `place`; kNone if nobody can stand there.
    uint32_t explore(const Vec3& place, size_t most);

    size_t size() const { return nodes_.size(); }
    const Vec3& place(uint32_t node) const { return nodes_[node].place; } // on the floor
    std::span<const uint32_t> links(uint32_t node) const { return nodes_[node].links; }

    // The place for something that stands there or hovers up to 2.2 m above it: the nearest within
    // `reach`, level, with nothing in between if there is such a one. kNone if there is none.
    uint32_t nearest(const Vec3& point, double reach = 1.5) const;

private:
    struct Node {
        Vec3 place;
        int32_t x, z;                // the cell
        std::vector<uint32_t> links; // in the order that they were found
        uint8_t tried = 0;           // directions that are linked from the other end
    };
    struct Level { // a floor of a cell, a place of the graph or not
        double height;
        bool has_room;
        uint32_t node;
    };

    Level* level_from(int32_t x, int32_t z, double height);
    uint32_t node_of(Level& level, int32_t x, int32_t z);
    uint32_t stand(const Vec3& place);
    std::optional<double> height_at(double x, double z, double height) const;
    bool has_room(const Vec3& place) const;
    bool has_headroom(const Vec3& from, const Vec3& to) const;
    bool can_go(const Vec3& from, const Vec3& to) const;
    void link(uint32_t from, uint32_t to);
    void try_direction(uint32_t node, uint32_t direction);
    bool can_see(const Vec3& from, const Vec3& floor) const;
    gameplay::Capsule torso(const Vec3& place) const;
    gameplay::Mask mask() const { return {layers_, ignored_}; }

    gameplay::World world_;
    gameplay::CharacterRules rules_;
    uint32_t layers_;
    std::vector<rt_mesh> ignored_;
    std::vector<Node> nodes_;
    size_t done_ = 0; // nodes whose directions were tried
    std::unordered_map<uint64_t, std::vector<Level>> columns_;
};

} // namespace peregrine::three_cores
