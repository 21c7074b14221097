#pragma once

#include "gameplay/world.h"

namespace peregrine::gameplay {

// Random numbers that are the same everywhere: SplitMix64 of Steele, Lea and Flood, "Fast
// splittable pseudorandom number generators" (OOPSLA 2014): a counter, well mixed.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
        uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // In [0, 1), a multiple of 2^-53.
    double uniform() { return double(next() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }

    // Less than `count` (> 0); off by less than count / 2^53 from even.
    uint32_t below(uint32_t count) { return uint32_t(uniform() * count); }

    // Even in the ball of radius 1.
    Vec3 in_ball() {
        for (;;) {
            const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
            if (x * x + y * y + z * z <= 1) return {x, y, z};
        }
    }

    uint64_t state() const { return state_; } // a generator with this seed goes on from here

private:
    uint64_t state_;
};

} // namespace peregrine::gameplay
