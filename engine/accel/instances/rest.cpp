#include "accel/instances/rest.h"

#include <algorithm>
#include <cmath>

namespace peregrine::accel::instances {
namespace {

double longest_side(const math::Box& box) {
    const math::Vec3d size = math::Vec3d(box.upper) - math::Vec3d(box.lower);
    return std::max({size.x, size.y, size.z});
}

float round_down(double value) {
    const auto rounded = float(value);
    return double(rounded) > value ? std::nextafter(rounded, -HUGE_VALF) : rounded;
}

void set_child(const ExactExtent& extent, const Node& node, uint32_t i, NodeRest& rest) {
    for (int k = 0; k < 3; ++k) {
        rest.lower[k][i] = round_down(extent.lower[k] - double(node.lower[k][i]));
        rest.upper[k][i] = -round_down(double(node.upper[k][i]) - extent.upper[k]);
    }
    rest.margin[i] = extent.margin;
}

} // namespace

void ExactExtent::extend(const ExactExtent& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
    margin = std::max(margin, other.margin);
}

bool are_far(std::span<const Extent> extents, const math::Box& bounds) {
    double margins = 0, sizes = 0;
    for (const Extent& extent : extents) {
        margins += double(extent.margin);
        sizes += longest_side(extent.box);
    }
    const double of_shapes = 0x1p-17 * longest_side(bounds) * double(extents.size());
    return 16 * margins + of_shapes > sizes;
}

void find_rests(std::span<const Node> nodes, std::span<const ExactExtent> extents,
                base::Memory* memory, base::Vector<NodeRest>& rests) {
    rests.resize(nodes.size());
    base::Vector<ExactExtent> whole(nodes.size(), memory); // of each node
    for (size_t at = nodes.size(); at-- > 0;) {            // children lie behind their parent
        const Node& node = nodes[at];
        const auto extent_of = [&](Link link) -> const ExactExtent& {
            return link.is_leaf() ? extents[link.instance()] : whole[link.node()];
        };
        whole[at] = extent_of(node.child[0]);
        for (uint32_t i = 0; i < node.count; ++i) {
            set_child(extent_of(node.child[i]), node, i, rests[at]);
            whole[at].extend(extent_of(node.child[i]));
        }
    }
}

} // namespace peregrine::accel::instances
