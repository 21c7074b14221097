#include "accel/bvh/front_to_back.h"

#include "accel/reference.h"

namespace peregrine::accel::bvh {
namespace {

static_assert(kWidth == 8);
constexpr Ints kPlaces[2] = {{0, 1, 2, 3}, {4, 5, 6, 7}};

// How many children come before each one.
void rank(const Floats* keys, Ints* ranks) {
    ranks[0] = ranks[1] = Ints{};
    for (int32_t i = 0; i < int32_t(kWidth); ++i) {
        const float key = keys[i / 4][i % 4];
        for (int half = 0; half < 2; ++half)
            ranks[half] -= (key < keys[half]) | ((key == keys[half]) & (i < kPlaces[half]));
    }
}

// Each place goes to the three bits that its rank says: floats hold 24 bits, and make powers of
// two.
uint32_t pack(const Ints* ranks) {
    Floats sum = {};
    for (int half = 0; half < 2; ++half)
        sum += __builtin_convertvector(kPlaces[half], Floats)
               * std::bit_cast<Floats>((3 * ranks[half] + 127) << 23);
    return uint32_t(sum[0] + sum[1] + sum[2] + sum[3]);
}

} // namespace

void sort_front_to_back(Node& node, uint32_t children) {
    constexpr float kMost = std::numeric_limits<float>::max();
    const int32_t count = int32_t(children);
    for (uint32_t octant = 0; octant < 4; ++octant) {
        const float x = (octant & 1) != 0 ? -1.0f : 1.0f;
        const float y = (octant & 2) != 0 ? -1.0f : 1.0f;
        Floats keys[2];
        for (int half = 0; half < 2; ++half) {
            const auto middle = [&](int axis) {
                return load4(node.lower[axis] + 4 * half) + load4(node.upper[axis] + 4 * half);
            };
            const Floats key = min(x * middle(0) + y * middle(1) + middle(2), Floats{} + kMost);
            keys[half] = kPlaces[half] < count ? key : Floats{} + Bounds::kInfinity;
        }
        Ints ranks[2], opposite[2];
        rank(keys, ranks);
        for (int half = 0; half < 2; ++half)
            opposite[half] = kPlaces[half] < count ? count - 1 - ranks[half] : ranks[half];
        node.order[octant] = pack(ranks);
        node.order[7 - octant] = pack(opposite);
    }
}

} // namespace peregrine::accel::bvh
