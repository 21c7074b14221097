#include "accel/kdtree/small_node.h"

#include "geometry/clip.h"

#include <algorithm>
#include <cstring>

namespace peregrine::accel::kdtree {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// GCC's and Clang's vectors: the loops are too short to be left to their vectorizers.
using Floats [[gnu::vector_size(16)]] = float;
using Ints [[gnu::vector_size(16)]] = int32_t;
using Doubles [[gnu::vector_size(16)]] = double;

constexpr uint32_t kLanes = 4;
constexpr uint32_t kMaxPlanes = 2 * SmallNode::kCapacity;
static_assert(kMaxPlanes % kLanes == 0);

Floats load(const float* from) {
    Floats vector;
    std::memcpy(&vector, from, sizeof vector);
    return vector;
}

Doubles minimum(const Doubles& a, const Doubles& b) {
    return a < b ? a : b;
}

// The planes of one axis with their costs.
struct Candidates {
    uint32_t count; // a multiple of kLanes
    float planes[kMaxPlanes + kLanes];
    double least[kMaxPlanes];
    double planar_right[kMaxPlanes]; // costs if the triangles in the plane go to the right
};

// Those strictly inside the cell; fills up with copies.
void list_planes(const SmallNode& node, const math::Box& cell, uint32_t axis,
                 Candidates& candidates) {
    const float lower = cell.lower[int(axis)];
    const float upper = cell.upper[int(axis)];
    uint32_t count = 0;
    const auto add = [&](float plane) {
        candidates.planes[count] = plane;
        count += uint32_t(plane > lower) & uint32_t(plane < upper);
    };
    for (uint32_t i = 0; i < node.count; ++i) {
        add(node.lower[axis][i]);
        add(node.upper[axis][i]);
    }
    for (uint32_t i = 1; i < kLanes; ++i) candidates.planes[count + i - 1] = candidates.planes[0];
    candidates.count = (count + kLanes - 1) / kLanes * kLanes;
}

// How many triangles reach to either side of the planes, and how many lie in them.
struct Counts {
    Ints left{};
    Ints right{};
    Ints planar{};

    Counts(const SmallNode& node, uint32_t axis, const Floats& planes) {
        for (uint32_t i = 0; i < node.count; ++i) {
            const Ints reaches_left = node.lower[axis][i] < planes;
            const Ints reaches_right = node.upper[axis][i] > planes;
            left -= reaches_left; // true is -1
            right -= reaches_right;
            planar -= ~(reaches_left | reaches_right);
        }
    }

    bool any_planar() const { return (planar[0] | planar[1] | planar[2] | planar[3]) != 0; }
};

// The lower or the upper half of a vector.
template <class Vector>
Doubles half(const Vector& vector, bool upper) {
    return upper ? __builtin_convertvector(__builtin_shufflevector(vector, vector, 2, 3), Doubles)
                 : __builtin_convertvector(__builtin_shufflevector(vector, vector, 0, 1), Doubles);
}

Doubles total_cost(const PlaneCost& cost, const Doubles& plane, const Doubles& left,
                   const Doubles& right) {
    const Doubles total = cost.node(cost.children(plane, left, right));
    if (!cost.has_bonus()) return total;
    return ((left == 0.0) | (right == 0.0)) ? total * cost.empty_factor() : total;
}

double find_costs(const SmallNode& node, const PlaneCost& cost, uint32_t axis,
                  Candidates& candidates) {
    Doubles least = {kInfinity, kInfinity};
    for (uint32_t first = 0; first < candidates.count; first += kLanes) {
        const Floats planes = load(candidates.planes + first);
        const Counts counts(node, axis, planes);
        const bool any_planar = counts.any_planar();
        for (uint32_t k = 0; k < kLanes; k += 2) {
            const Doubles plane = half(planes, k > 0);
            const Doubles left = half(counts.left, k > 0);
            const Doubles right = half(counts.right, k > 0);
            const Doubles planar = half(counts.planar, k > 0);
            const Doubles planar_right = total_cost(cost, plane, left, right + planar);
            const Doubles best =
                any_planar ? minimum(planar_right, total_cost(cost, plane, left + planar, right))
                           : planar_right;
            least = minimum(least, best);
            std::memcpy(candidates.least + first + k, &best, sizeof best);
            std::memcpy(candidates.planar_right + first + k, &planar_right, sizeof planar_right);
        }
    }
    return std::min(least[0], least[1]);
}

// Of planes of equal cost the least.
void locate(const Candidates& candidates, SmallSplit& split) {
    split.position = std::numeric_limits<float>::infinity();
    for (uint32_t i = 0; i < candidates.count; ++i) {
        if (candidates.least[i] != split.cost || candidates.planes[i] >= split.position) continue;
        split.position = candidates.planes[i];
        split.planar_left = candidates.planar_right[i] != split.cost;
    }
}

enum Sides : uint32_t { kLeft = 1, kRight = 2 };

uint32_t sides(const SmallNode& node, uint32_t i, const SmallSplit& split) {
    const uint32_t sides = (node.lower[split.axis][i] < split.position ? kLeft : 0u)
                           | (node.upper[split.axis][i] > split.position ? kRight : 0u);
    return sides != 0 ? sides : split.planar_left ? uint32_t(kLeft) : uint32_t(kRight);
}

} // namespace

SmallSplit find_small_split(const SmallNode& node, const math::Box& cell, const CostModel& model,
                            double limit) {
    Candidates candidates[3];
    SmallSplit split;
    for (uint32_t axis = 0; axis < 3; ++axis) list_planes(node, cell, axis, candidates[axis]);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const PlaneCost cost(model, cell, axis);
        const double least = find_costs(node, cost, axis, candidates[axis]);
        if (least >= split.cost) continue;
        split.cost = least;
        split.axis = axis;
    }
    if (split.cost >= limit) return split;
    locate(candidates[split.axis], split);
    for (uint32_t i = 0; i < node.count; ++i) {
        const uint32_t to = sides(node, i, split);
        split.left += (to & kLeft) != 0;
        split.right += (to & kRight) != 0;
    }
    return split;
}

void split_small_node(const SmallNode& node, const geometry::Triangle* triangles,
                      const math::Box& cell, const SmallSplit& split, SmallNode& left,
                      SmallNode& right) {
    const uint32_t count = node.count;
    left.count = 0;
    right.count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t id = node.ids[i];
        const math::Box box = node.box(i);
        const uint32_t to = sides(node, i, split);
        if (to == (kLeft | kRight)) {
            const geometry::ClippedHalves halves =
                geometry::clip_to_halves(triangles[id], cell, split.axis, split.position, box);
            if (!halves.below.empty()) left.add(id, halves.below);
            if (!halves.above.empty()) right.add(id, halves.above);
        } else if (to == kLeft) {
            left.add(id, box);
        } else {
            right.add(id, box);
        }
    }
}

} // namespace peregrine::accel::kdtree
