#pragma once

#include "base/memory.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"
#include "math/box.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace peregrine::accel {

// GCC's and Clang's vectors: x, y, z and a lane that is ignored.
using Floats [[gnu::vector_size(16)]] = float;
using Ints [[gnu::vector_size(16)]] = int32_t;

inline Floats min(const Floats& a, const Floats& b) {
    return a < b ? a : b;
}
inline Floats max(const Floats& a, const Floats& b) {
    return a > b ? a : b;
}

inline Floats load(const math::Vec3& v) {
    return Floats{v.x, v.y, v.z, 0};
}

inline Floats load4(const float* values) {
    Floats vector;
    std::memcpy(&vector, values, sizeof vector);
    return vector;
}

inline void store4(const Floats& vector, float* values) {
    std::memcpy(values, &vector, sizeof vector);
}

// Four vectors, axis by axis.
struct Axes {
    Floats x, y, z;
};
inline Axes transpose(const Floats& a, const Floats& b, const Floats& c, const Floats& d) {
    const Floats ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Floats cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Floats ab_z = __builtin_shufflevector(a, b, 2, 6, 2, 6);
    const Floats cd_z = __builtin_shufflevector(c, d, 2, 6, 2, 6);
    return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5),
            __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
            __builtin_shufflevector(ab_z, cd_z, 0, 1, 4, 5)};
}

// As math::Box, in vectors.
struct Bounds {
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Floats lower = {kInfinity, kInfinity, kInfinity, kInfinity};
    Floats upper = {-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void extend(const Bounds& other) {
        lower = min(lower, other.lower);
        upper = max(upper, other.upper);
    }
    void extend(const Floats& point) {
        lower = min(lower, point);
        upper = max(upper, point);
    }
    bool empty() const { return lower[0] > upper[0] || lower[1] > upper[1] || lower[2] > upper[2]; }
    math::Box box() const {
        return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
    }
};

// A vertex of a triangle, and four bytes of something else.
inline Floats vertex_of(const geometry::Triangle& triangle, uint32_t vertex) {
    return load4(reinterpret_cast<const float*>(&triangle) + 4 * vertex);
}

// With other bits in the lane that is ignored.
inline Floats with_last_lane(const Floats& v, uint32_t bits) {
    return std::bit_cast<Floats>((std::bit_cast<Ints>(v) & Ints{-1, -1, -1, 0})
                                 | Ints{0, 0, 0, int32_t(bits)});
}

inline Bounds bounds_of(const geometry::Triangle& triangle) {
    const Floats a = with_last_lane(vertex_of(triangle, 0), 0);
    const Floats b = with_last_lane(vertex_of(triangle, 1), 0);
    const Floats c = with_last_lane(vertex_of(triangle, 2), 0);
    return {min(min(a, b), c), max(max(a, b), c)};
}

inline float half_area(const Floats& size) {
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

// A triangle, or what splits left of it, by its box.
struct alignas(16) Reference {
    // So that the number, read as a float, is neither denormal, which is slow to add, nor a NaN.
    static constexpr uint32_t kBias = 0x40000000u;

    float lower[3];
    uint32_t biased_triangle;
    float upper[3];
    uint32_t biased_weight;

    uint32_t triangle() const { return biased_triangle - kBias; }
    uint32_t weight() const { return biased_weight - kBias; } // triangles

    Bounds bounds() const { return {load4(lower), load4(upper)}; }
    Floats doubled_center() const {
        const Bounds box = bounds();
        return box.lower + box.upper;
    }
    void set(uint32_t triangle, const Bounds& bounds, uint32_t weight = 1) {
        store4(with_last_lane(bounds.lower, triangle + kBias), lower);
        store4(with_last_lane(bounds.upper, weight + kBias), upper);
    }
    static Reference make(uint32_t triangle, const Bounds& bounds, uint32_t weight = 1) {
        Reference reference;
        reference.set(triangle, bounds, weight);
        return reference;
    }
};
static_assert(sizeof(Reference) == 32);

// Box of references and of their doubled centres.
struct Extent {
    Bounds bounds;
    Bounds centers;

    void extend(const Reference& reference) { extend(reference.bounds()); }
    void extend(const Bounds& box) {
        bounds.extend(box);
        centers.extend(box.lower + box.upper);
    }
};

Extent extent_of(std::span<const Reference> references);
Extent extent_of(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                 base::Memory* memory);

// The references of a list of triangles, one each, into room for as many; returns what they span.
Extent make_references(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                       base::Memory* memory, Reference* references);

} // namespace peregrine::accel
