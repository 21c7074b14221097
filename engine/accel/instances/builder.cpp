#include "accel/instances/builder.h"

#include <algorithm>

namespace peregrine::accel::instances {
namespace {

int widest_axis(std::span<const Place> part) {
    math::Box centers;
    for (const Place& place : part) centers.extend(place.center);
    const math::Vec3 size = centers.upper - centers.lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Returns the place of the root of `part`.
uint32_t build_node(std::span<const Extent> extents, std::span<Place> part,
                    base::Vector<Node>& nodes) {
    const auto place = uint32_t(nodes.size());
    if (part.size() == 1) {
        nodes.push_back({extents[part[0].instance], 0, part[0].instance});
        return place;
    }
    nodes.emplace_back();
    const int axis = widest_axis(part);
    const size_t half = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + std::ptrdiff_t(half), part.end(),
                     [axis](const Place& a, const Place& b) {
                         const float x = a.center[axis], y = b.center[axis];
                         return x < y || (x == y && a.instance < b.instance);
                     });
    build_node(extents, part.first(half), nodes);
    const uint32_t right = build_node(extents, part.subspan(half), nodes);
    Extent both = nodes[place + 1].extent;
    both.extend(nodes[right].extent);
    nodes[place] = {both, right, 0};
    return place;
}

} // namespace

void Extent::extend(const Extent& other) {
    box.extend(other.box);
    margin = std::max(margin, other.margin);
    slope = std::max(slope, other.slope);
}

void build(std::span<const Extent> extents, base::Vector<Place>& places,
           base::Vector<Node>& nodes) {
    nodes.clear();
    if (extents.empty()) return;
    nodes.reserve(2 * extents.size() - 1);
    places.clear();
    places.reserve(extents.size());
    for (const Extent& extent : extents) // a sum could overflow, a sum of halves cannot
        places.push_back(
            {0.5f * extent.box.lower + 0.5f * extent.box.upper, uint32_t(places.size())});
    build_node(extents, places, nodes);
}

} // namespace peregrine::accel::instances
