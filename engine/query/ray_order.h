#pragma once

#include "query/records.h"

#include <cstdint>

// Rays of a large batch that have nothing to do with their neighbours are traced in another order:
// by the octant of their directions, then by where they begin. So those that go through the same
// nodes go together.
namespace peregrine::query {

// Whether most rays from `first` to `end` begin far from the one before, by a sample; of few rays
// never. A sort is worth its time then.
bool are_scattered(const Rays& rays, uint64_t first, uint64_t end);

class RayOrder {
public:
    static constexpr uint32_t kWindow = 16384; // rays that are sorted at a time

    // Of `count` rays from `first` on, kWindow or less.
    void sort(const Rays& rays, uint64_t first, uint32_t count);

    // The ray in place i of the order, counted from `first`.
    uint32_t operator[](uint32_t i) const { return order_[i]; }

private:
    static constexpr uint32_t kCells = 8; // along an axis
    static constexpr uint32_t kKeys = 8 * kCells * kCells * kCells;

    uint16_t order_[kWindow];
    uint16_t key_[kWindow];
    uint32_t place_[kKeys];
};

} // namespace peregrine::query
