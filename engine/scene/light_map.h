#pragma once

#include "base/memory.h"
#include "math/vec.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace peregrine::scene {

struct Geometry;

// Values at points of triangles, between which they are interpolated. A triangle's points are the
// corners of 4^level patches, cut by lines parallel to its edges, row by row from v = 0.
struct PointGrids {
    static constexpr uint32_t kMaxLevel = 7;
    static constexpr uint32_t kLevelShift = 29;
    static constexpr uint32_t kMostPoints = 1u << kLevelShift; // of all triangles

    static constexpr uint32_t count(uint32_t level) {
        const uint32_t side = 1u << level;
        return (side + 1) * (side + 2) / 2;
    }
    static constexpr uint32_t index(uint32_t level, uint32_t iu, uint32_t iv) {
        const uint32_t twice = 2 * (1u << level) + 3;
        return iv * (twice - iv) / 2 + iu;
    }
    static constexpr uint32_t bits(uint32_t level, uint32_t first) {
        return level << kLevelShift | first;
    }

    explicit PointGrids(base::Memory* memory) : grids(memory), values(memory) {}

    bool any() const { return !grids.empty(); }
    uint64_t bytes() const { return (grids.size() + values.size()) * sizeof(uint32_t); }

    base::Vector<uint32_t> grids;  // bits() of each triangle
    base::Vector<uint32_t> values; // by point
};

// Three points of a triangle's grid, and what each of them counts for at a place between them.
struct GridPlace {
    uint32_t index[3];
    float weight[3];

    // (u, v): barycentrics. The SIMD form (shade/baked) does the same operations.
    GridPlace(uint32_t level, float u, float v) {
        const auto side = 1u << level;
        const auto wide = float(side);
        const float x = std::clamp(u * wide, 0.0f, wide), y = std::clamp(v * wide, 0.0f, wide);
        const uint32_t iv = std::min(uint32_t(y), side - 1);
        const uint32_t iu = std::min(uint32_t(x), side - 1 - iv);
        const float fu = x - float(iu), fv = y - float(iv);
        // A row's last patch has no mirror image, whatever rounding says.
        const bool upper = fu + fv > 1.0f && iu + iv + 1 < side;
        const auto at = [&](uint32_t du, uint32_t dv) {
            return PointGrids::index(level, iu + du, iv + dv);
        };
        index[0] = upper ? at(1, 1) : at(0, 0);
        index[1] = upper ? at(0, 1) : at(1, 0);
        index[2] = upper ? at(1, 0) : at(0, 1);
        weight[1] = upper ? 1.0f - fu : fu;
        weight[2] = upper ? 1.0f - fv : fv;
        weight[0] = std::max((1.0f - weight[1]) - weight[2], 0.0f);
    }
};

// What comes to the fronts of fixed triangles from all around. Immutable once baked (render/bake).
struct LightMap {
    explicit LightMap(base::Memory* memory) : openness(memory), bounced(memory) {}

    std::shared_ptr<const Geometry> geometry; // whose triangles
    float range = 0;                          // of openness, in metres
    PointGrids openness;                      // how much of the ambient light arrives, in 65535ths
    PointGrids bounced;                       // what other surfaces send, as SharedExponent

    uint64_t bytes() const { return sizeof *this + openness.bytes() + bounced.bytes(); }
};

// A colour in 32 bits: three times 9 bits, and 5 for the exponent of all, so that the largest
// channel has 9 significant bits from 2^-15 to 2^16.
struct SharedExponent {
    static constexpr int kBits = 9, kBias = 15;
    static constexpr uint32_t kMost = (1u << kBits) - 1;

    static uint32_t encode(const math::Vec3& color);
    static math::Vec3 decode(uint32_t bits);
};

} // namespace peregrine::scene
