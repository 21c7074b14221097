#include "accel/instances/builder.h"

#include <algorithm>
#include <numeric>

namespace peregrine::accel::instances {
namespace {

// A sum could overflow, a sum of halves cannot.
float center(const Extent& extent, int axis) {
    return 0.5f * extent.box.lower[axis] + 0.5f * extent.box.upper[axis];
}

int widest_axis(std::span<const Extent> extents, std::span<const uint32_t> part) {
    math::Box centers;
    for (const uint32_t i : part)
        centers.extend(
            math::Vec3(center(extents[i], 0), center(extents[i], 1), center(extents[i], 2)));
    const math::Vec3 size = centers.upper - centers.lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Returns the place of the root of `part`.
uint32_t build_node(std::span<const Extent> extents, std::span<uint32_t> part,
                    base::Vector<Node>& nodes) {
    const auto place = uint32_t(nodes.size());
    if (part.size() == 1) {
        nodes.push_back({extents[part[0]], 0, part[0]});
        return place;
    }
    nodes.emplace_back();
    const int axis = widest_axis(extents, part);
    const size_t half = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + std::ptrdiff_t(half), part.end(),
                     [&](uint32_t a, uint32_t b) {
                         const float x = center(extents[a], axis), y = center(extents[b], axis);
                         return x < y || (x == y && a < b);
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

void build(std::span<const Extent> extents, base::Vector<uint32_t>& order,
           base::Vector<Node>& nodes) {
    nodes.clear();
    if (extents.empty()) return;
    nodes.reserve(2 * extents.size() - 1);
    order.resize(extents.size());
    std::iota(order.begin(), order.end(), 0u);
    build_node(extents, order, nodes);
}

} // namespace peregrine::accel::instances
