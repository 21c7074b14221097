#include "accel/bvh/front_to_back.h"

namespace peregrine::accel::bvh {
namespace {

// The place of each child in the order, by counting those before it.
void rank(const float* keys, uint32_t children, uint32_t* ranks) {
    for (uint32_t i = 0; i < children; ++i) {
        uint32_t before = 0;
        for (uint32_t k = 0; k < i; ++k) before += keys[k] <= keys[i];
        for (uint32_t k = i + 1; k < children; ++k) before += keys[k] < keys[i];
        ranks[i] = before;
    }
}

} // namespace

void sort_front_to_back(Node& node, uint32_t children) {
    float middle[3][kWidth];
    for (uint32_t axis = 0; axis < 3; ++axis)
        for (uint32_t i = 0; i < children; ++i)
            middle[axis][i] = node.lower[axis][i] + node.upper[axis][i];
    uint32_t empty = 0;
    for (uint32_t i = children; i < kWidth; ++i) empty |= i << 3 * i;
    for (uint32_t octant = 0; octant < 4; ++octant) {
        const float x = (octant & 1) != 0 ? -1.0f : 1.0f;
        const float y = (octant & 2) != 0 ? -1.0f : 1.0f;
        float keys[kWidth];
        for (uint32_t i = 0; i < children; ++i)
            keys[i] = x * middle[0][i] + y * middle[1][i] + middle[2][i];
        uint32_t ranks[kWidth];
        rank(keys, children, ranks);
        uint32_t order = empty;
        uint32_t opposite = empty;
        for (uint32_t i = 0; i < children; ++i) {
            order |= i << 3 * ranks[i];
            opposite |= i << 3 * (children - 1 - ranks[i]);
        }
        node.order[octant] = order;
        node.order[7 - octant] = opposite;
    }
}

} // namespace peregrine::accel::bvh
