#include "accel/instances/builder.h"

#include <algorithm>

namespace peregrine::accel::instances {
namespace {

using Places = std::span<Place>;

int widest_axis(Places part) {
    math::Box centers;
    for (const Place& place : part) centers.extend(place.center);
    const math::Vec3 size = centers.upper - centers.lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// Returns the first of the second half.
size_t halve(Places part) {
    const int axis = widest_axis(part);
    const size_t half = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + std::ptrdiff_t(half), part.end(),
                     [axis](const Place& a, const Place& b) {
                         const float x = a.center[axis], y = b.center[axis];
                         return x < y || (x == y && a.instance < b.instance);
                     });
    return half;
}

// Calls visit(part) for up to 2^halvings parts, none smaller than half a node.
template <class Visit>
void for_each_part(Places all, uint32_t halvings, Visit&& visit) {
    if (halvings == 0 || all.size() <= kWidth) return visit(all);
    const size_t half = halve(all);
    for_each_part(all.first(half), halvings - 1, visit);
    for_each_part(all.subspan(half), halvings - 1, visit);
}

void set_child(Node& node, uint32_t i, const Extent& extent, Link link) {
    for (int k = 0; k < 3; ++k) {
        node.lower[k][i] = extent.box.lower[k];
        node.upper[k][i] = extent.box.upper[k];
    }
    node.margin[i] = extent.margin;
    node.slope[i] = extent.slope;
    node.child[i] = link;
}

Extent build_node(std::span<const Extent> extents, Places all, base::Vector<Node>& nodes) {
    const size_t at = nodes.size();
    nodes.emplace_back();
    uint32_t count = 0;
    Extent whole;
    const auto add = [&](Places part) {
        const auto next = uint32_t(nodes.size());
        const bool is_leaf = part.size() == 1;
        const Extent extent =
            is_leaf ? extents[part[0].instance] : build_node(extents, part, nodes);
        set_child(nodes[at], count++, extent,
                  is_leaf ? Link{Link::kLeaf | part[0].instance} : Link{next});
        whole.extend(extent);
    };
    if (all.size() <= kWidth)
        for (size_t i = 0; i < all.size(); ++i) add(all.subspan(i, 1));
    else
        for_each_part(all, 3, add);
    nodes[at].count = count;
    return whole;
}

} // namespace

void Extent::extend(const Extent& other) {
    box.extend(other.box);
    margin = std::max(margin, other.margin);
    slope = std::max(slope, other.slope);
}

math::Box build(std::span<const Extent> extents, base::Vector<Place>& places,
                base::Vector<Node>& nodes) {
    nodes.clear();
    if (extents.empty()) return {};
    nodes.reserve(extents.size() / 2 + 1); // leaves come by four or more, nodes by two or more
    places.clear();
    places.reserve(extents.size());
    for (const Extent& extent : extents) // a sum could overflow, a sum of halves cannot
        places.push_back(
            {0.5f * extent.box.lower + 0.5f * extent.box.upper, uint32_t(places.size())});
    return build_node(extents, places, nodes).box;
}

} // namespace peregrine::accel::instances
