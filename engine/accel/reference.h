#pragma once

#include "base/memory.h"
#include "base/scheduler.h"
#include "geometry/triangle.h"
#include "math/box.h"

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

    Bounds bounds() const {
        Bounds bounds;
        std::memcpy(&bounds.lower, lower, sizeof bounds.lower);
        std::memcpy(&bounds.upper, upper, sizeof bounds.upper);
        return bounds;
    }
    Floats doubled_center() const {
        const Bounds box = bounds();
        return box.lower + box.upper;
    }
    static Reference make(uint32_t triangle, const Bounds& bounds, uint32_t weight = 1) {
        Reference reference;
        std::memcpy(reference.lower, &bounds.lower, sizeof bounds.lower);
        std::memcpy(reference.upper, &bounds.upper, sizeof bounds.upper);
        reference.biased_triangle = triangle + kBias;
        reference.biased_weight = weight + kBias;
        return reference;
    }
};
static_assert(sizeof(Reference) == 32);

// Box of references and of their doubled centres.
struct Extent {
    Bounds bounds;
    Bounds centers;

    void extend(const Reference& reference) {
        bounds.extend(reference.bounds());
        centers.extend(reference.doubled_center());
    }
};

Extent extent_of(std::span<const Reference> references);

// The references of a list of triangles, one each, into room for as many; returns what they span.
Extent make_references(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
                       base::Memory* memory, Reference* references);

} // namespace peregrine::accel
