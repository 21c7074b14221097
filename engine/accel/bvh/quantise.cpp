#include "accel/bvh/quantise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace peregrine::accel::bvh {
namespace {

constexpr uint32_t kLastPlane = 255;
constexpr uint32_t kUnusedBits = 255; // of a scale

// The next scale that is at least so large.
float next_scale(float at_least) {
    const uint32_t bits = std::bit_cast<uint32_t>(at_least);
    return std::bit_cast<float>((bits + kUnusedBits) & ~kUnusedBits);
}

class Ruler {
public:
    Ruler(CompactNode& node, uint32_t axis) : node_(node), axis_(axis) {}

    // Until the last plane lies at `upper` or beyond. Coordinates are at most 1e30, so it comes.
    void span(float lower, float upper) {
        node_.origin[axis_] = lower;
        const double steps = (double(upper) - double(lower)) / kLastPlane;
        float& scale = node_.scale[axis_];
        scale = next_scale(std::max(float(steps), std::numeric_limits<float>::min()));
        while (at(kLastPlane) < upper)
            scale = next_scale(std::nextafter(scale, std::numeric_limits<float>::max()));
    }

    // The last plane that is not beyond; planes do not fall.
    uint8_t below(float coordinate) const {
        uint32_t plane = guess(coordinate);
        while (plane < kLastPlane && at(plane + 1) <= coordinate) ++plane;
        while (at(plane) > coordinate) --plane;
        return uint8_t(plane);
    }
    // The first one that is not before.
    uint8_t above(float coordinate) const {
        uint32_t plane = guess(coordinate);
        while (plane > 0 && at(plane - 1) >= coordinate) --plane;
        while (at(plane) < coordinate) ++plane;
        return uint8_t(plane);
    }

private:
    float at(uint32_t plane) const { return node_.plane(axis_, uint8_t(plane)); }
    uint32_t guess(float coordinate) const {
        const double steps =
            (double(coordinate) - double(node_.origin[axis_])) / double(node_.scale[axis_]);
        return uint32_t(std::clamp(steps, 0.0, double(kLastPlane)));
    }

    CompactNode& node_;
    uint32_t axis_;
};

} // namespace

void quantise(const Node& node, uint32_t children, CompactNode& out) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
        Ruler ruler(out, axis);
        ruler.span(*std::min_element(node.lower[axis], node.lower[axis] + children),
                   *std::max_element(node.upper[axis], node.upper[axis] + children));
        for (uint32_t i = 0; i < children; ++i) {
            out.lower[axis][i] = ruler.below(node.lower[axis][i]);
            out.upper[axis][i] = ruler.above(node.upper[axis][i]);
        }
    }
}

} // namespace peregrine::accel::bvh
