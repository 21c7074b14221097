#pragma once

#include "math/ray.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <span>

namespace peregrine::bench {

// Random things that ray sets are made of, the same for the same seed.
class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}

    float uniform() { return float(engine_() >> 8) * 0x1p-24f; } // in [0, 1)

    math::Vec3 direction() { // unit, uniform over the sphere
        const float z = 1 - 2 * uniform(), r = std::sqrt(1 - z * z);
        const float angle = kTurn * uniform();
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

    math::Vec3 cosine(const math::Vec3& normal) { // unit, cosine-distributed around a unit normal
        for (;;) {
            const math::Vec3 sum = normal + direction();
            const float length = glm::length(sum);
            if (length > 1e-3f) return sum / length;
        }
    }

    // In empty space: between an eye and what it sees along one of its rays.
    math::Vec3 free_point(std::span<const math::Ray> rays, std::span<const float> t) {
        for (;;) {
            const size_t i = engine_() % rays.size();
            const float along = uniform();
            if (std::isfinite(t[i]))
                return rays[i].origin + 0.98f * along * t[i] * rays[i].direction;
        }
    }

private:
    static constexpr float kTurn = 6.2831853f;
    std::mt19937 engine_;
};

} // namespace peregrine::bench
