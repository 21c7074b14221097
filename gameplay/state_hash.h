#pragma once

#include "gameplay/world.h"

#include <bit>

namespace peregrine::gameplay {

// 64 bits that tell states of a game apart: of the bits of its numbers, in order. -0 counts as 0,
// and every NaN as one.
class StateHash {
public:
    void add(uint64_t word) {
        hash_ = (hash_ ^ word) * 0x9e3779b97f4a7c15u;
        hash_ ^= hash_ >> 32;
    }
    void add(uint32_t word) { add(uint64_t(word)); }
    void add(double number) {
        constexpr uint64_t kNaN = 0x7ff8000000000000u;
        add(number != number ? kNaN : std::bit_cast<uint64_t>(number + 0.0));
    }
    void add(const Vec3& v) {
        for (int k = 0; k < 3; ++k) add(v[k]);
    }

    uint64_t value() const { return hash_; }

private:
    uint64_t hash_ = 0x243f6a8885a308d3u; // the fraction of pi: as good as any
};

} // namespace peregrine::gameplay
