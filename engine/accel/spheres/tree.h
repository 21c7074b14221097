#pragma once

#include "base/memory.h"
#include "math/box.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace peregrine::accel::spheres {

struct Sphere {
    math::Vec3 center;
    float radius;
};
static_assert(sizeof(Sphere) == 16, "four to a cache line: the children of a node");

// Spheres of centres up to kLargest and radii from kSmallest to kLargest; their squares are floats.
inline constexpr float kLargest = 1e18f;
inline constexpr float kSmallest = 1e-18f;

// Whether they meet. Never misses that they do: the margin covers the rounding of all but radii,
// whose own is the builder's.
inline bool meets(const Sphere& sphere, const math::Box& box) {
    const math::Vec3 nearest = glm::min(glm::max(sphere.center, box.lower), box.upper);
    const math::Vec3 offset = sphere.center - nearest;
    return glm::dot(offset, offset) <= sphere.radius * sphere.radius * 1.0001f;
}

// A tree of bounding spheres (Bikker 2007, section 3.2.2), four children a node. Level 0 are the
// items along Morton's curve; node i of the next level encloses nodes 4 i to 4 i + 3 of this one.
struct Tree {
    static constexpr uint32_t kMostLevels = 17; // 4^16 items

    explicit Tree(base::Memory* memory) : spheres(memory), items(memory) {}

    base::Vector<Sphere> spheres;                  // level after level
    base::Vector<uint32_t> items;                  // whose sphere each of level 0 is
    std::array<uint32_t, kMostLevels + 1> first{}; // of each level, and behind the last
    uint32_t levels = 0;

    uint32_t size(uint32_t level) const { return first[level + 1] - first[level]; }

    // Calls visit(item) for each whose sphere meets the box, in no particular order.
    template <class Visit>
    void for_each_near(const math::Box& box, Visit&& visit) const {
        if (levels > 0) descend(levels - 1, 0, box, visit);
    }

private:
    template <class Visit>
    void descend(uint32_t level, uint32_t node, const math::Box& box, Visit&& visit) const {
        if (!meets(spheres[first[level] + node], box)) return;
        if (level == 0) return visit(items[node]);
        const uint32_t end = std::min(4 * node + 4, size(level - 1));
        for (uint32_t child = 4 * node; child < end; ++child) descend(level - 1, child, box, visit);
    }
};

} // namespace peregrine::accel::spheres
