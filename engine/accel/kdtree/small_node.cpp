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
using HalfFloats [[gnu::vector_size(8)]] = float;
using HalfInts [[gnu::vector_size(8)]] = int32_t;
using Doubles [[gnu::vector_size(16)]] = double;

constexpr uint32_t kLanes = 4;
constexpr uint32_t kMaxPlanes = 2 * SmallNode::kCapacity;
static_assert(kMaxPlanes % kLanes == 0);

template <class Vector, class Scalar>
Vector load(const Scalar* from) {
    Vector vector;
    std::memcpy(&vector, from, sizeof vector);
    return vector;
}

Doubles minimum(const Doubles& a, const Doubles& b) {
    return a < b ? a : b;
}

// The planes of one axis with their costs.
struct Candidates {
    uint32_t count; // a multiple of kLanes
    float planes[kMaxPlanes];
    double least[kMaxPlanes];
    double planar_right[kMaxPlanes]; // costs if the triangles in the plane go to the right
};

// Fills up with planes on the cell's border, which do not count.
void list_planes(const SmallNode& node, float border, uint32_t axis, Candidates& candidates) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < node.count; ++i) {
        candidates.planes[count++] = node.lower[axis][i];
        candidates.planes[count++] = node.upper[axis][i];
    }
    while (count % kLanes != 0) candidates.planes[count++] = border;
    candidates.count = count;
}

// How many triangles each child gets, with and without those that lie in the plane.
struct Counts {
    Ints left{};
    Ints right{};
    Ints left_and_planar;
    Ints right_and_planar;

    Counts(const SmallNode& node, uint32_t axis, const Floats& planes) {
        Ints planar{};
        for (uint32_t i = 0; i < node.count; ++i) {
            const Ints reaches_left = node.lower[axis][i] < planes;
            const Ints reaches_right = node.upper[axis][i] > planes;
            left -= reaches_left; // true is -1
            right -= reaches_right;
            planar -= ~(reaches_left | reaches_right);
        }
        left_and_planar = left + planar;
        right_and_planar = right + planar;
    }
};

Doubles half(const Ints& vector, uint32_t first) {
    return __builtin_convertvector(
        load<HalfInts>(reinterpret_cast<const int32_t*>(&vector) + first), Doubles);
}

Doubles total_cost(const PlaneCost& cost, const Doubles& plane, const Doubles& left,
                   const Doubles& right) {
    const Doubles total = cost.node(cost.children(plane, left, right));
    if (!cost.has_bonus()) return total;
    return (left == 0.0) | (right == 0.0) ? total * cost.empty_factor() : total;
}

double find_costs(const SmallNode& node, const math::Box& cell, const PlaneCost& cost,
                  uint32_t axis, Candidates& candidates) {
    const double lower = double(cell.lower[int(axis)]);
    const double upper = double(cell.upper[int(axis)]);
    const Doubles infinity = {kInfinity, kInfinity};
    Doubles least = infinity;
    list_planes(node, cell.lower[int(axis)], axis, candidates);
    for (uint32_t first = 0; first < candidates.count; first += kLanes) {
        const Counts counts(node, axis, load<Floats>(candidates.planes + first));
        for (uint32_t k = 0; k < kLanes; k += 2) {
            const Doubles plane =
                __builtin_convertvector(load<HalfFloats>(candidates.planes + first + k), Doubles);
            const Doubles planar_left =
                total_cost(cost, plane, half(counts.left_and_planar, k), half(counts.right, k));
            const Doubles planar_right =
                total_cost(cost, plane, half(counts.left, k), half(counts.right_and_planar, k));
            const Doubles best =
                (plane > lower) & (plane < upper) ? minimum(planar_left, planar_right) : infinity;
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

uint32_t sides(float lower, float upper, const SmallSplit& split) {
    const uint32_t sides =
        (lower < split.position ? kLeft : 0u) | (upper > split.position ? kRight : 0u);
    return sides != 0 ? sides : split.planar_left ? uint32_t(kLeft) : uint32_t(kRight);
}

} // namespace

SmallSplit find_small_split(const SmallNode& node, const math::Box& cell, const CostModel& model,
                            double limit) {
    Candidates candidates[3];
    SmallSplit split;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const PlaneCost cost(model, cell, axis);
        const double least = find_costs(node, cell, cost, axis, candidates[axis]);
        if (least >= split.cost) continue;
        split.cost = least;
        split.axis = axis;
    }
    if (split.cost < limit) locate(candidates[split.axis], split);
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
        const uint32_t to = sides(node.lower[split.axis][i], node.upper[split.axis][i], split);
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
