#pragma once

#include "base/isa.h"
#include "geometry/triangle.h"
#include "math/box.h"
#include "math/ray.h"
#include "trace/filter.h"
#include "trace/visitor.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>

namespace peregrine::trace {

struct ShapeKernels; // trace/shapes/shapes.h

enum class Structure : uint32_t { bvh = 0, kdtree = 1, bih = 2 };

// What rays are traced against: triangles under a structure. What the structure looks like is
// between those who make targets and its own kernels (trace/bvh/target.h, ...).
struct Target {
    Target() = default;

    // `View`: pointers to the structure's arrays.
    template <class View>
    Target(const geometry::TriangleInfo* triangle_infos, const math::Box& triangle_bounds,
           const View& view)
        : infos(triangle_infos), bounds(triangle_bounds) {
        static_assert(std::is_trivially_copyable_v<View> && sizeof(View) <= sizeof view_
                      && alignof(View) <= alignof(void*));
        ::new (static_cast<void*>(view_)) View(view);
    }

    // Of the same type.
    template <class View>
    const View& view() const {
        return *std::launder(reinterpret_cast<const View*>(view_));
    }

    const geometry::TriangleInfo* infos = nullptr;
    math::Box bounds; // of all triangles

private:
    alignas(void*) std::byte view_[4 * sizeof(void*)] = {};
};

// The closest hit of one ray.
struct Hit {
    float t;
    float u;
    float v;
    uint32_t triangle; // index in Target::infos, kNoTriangle for a miss (then t = +infinity)
    bool back_face;
    uint32_t steps; // nodes visited
};

inline Hit miss(uint32_t steps) {
    return {std::numeric_limits<float>::infinity(), 0, 0, geometry::kNoTriangle, false, steps};
}

// What hits of equal t go by: fronts before backs, then the smaller index. kNoTriangle is the
// largest key; indices are below 2^31.
constexpr uint32_t kBackFaceKey = 0x80000000u;
constexpr uint32_t key_of(uint32_t index, bool back_face) {
    return index | uint32_t(back_face) << 31;
}

// Smaller t first; of equal ones the smaller key. Independent of any order of visits. `best_t` is
// the end of the ray while `best` is kNoTriangle.
inline bool comes_first(float t, uint32_t key, float best_t, uint32_t best) {
    return t < best_t || (t == best_t && key < best);
}

// While a kernel looks for the best hit, its triangle is a key. This ends that.
inline void name(Hit& best) {
    if (best.triangle == geometry::kNoTriangle) return;
    best.back_face = best.triangle >> 31;
    best.triangle &= ~kBackFaceKey;
}

// What is known of a stream's rays; it changes the speed, not the answers.
enum class Coherence : uint32_t {
    automatic = 0,
    coherent = 1,      // neighbours are alike
    common_origin = 2, // ... and all start at one point
    incoherent = 3,
};

// A square of an image's pixels. The ray of pixel (x, y) has the direction
//     (corner + right * (x + 0.5)) + down * (y + 0.5)
// in float, each operation rounded, and t from 0 to infinity.
struct ImageTile {
    static constexpr uint32_t kSide = 32;
    math::Vec3 corner, right, down;
    uint32_t x, y; // of its first pixel
};

// Rays as separate arrays, `count` long. Arrays are 64-byte aligned and padded to a multiple of 16.
struct RayStream {
    const float* origin[3];
    const float* direction[3];
    const float* t_min;
    const float* t_max;
    uint32_t count;
    Coherence coherence = Coherence::automatic;
    // If there, these are the rays of a whole tile from a common origin, along Morton's curve (x
    // first).
    const ImageTile* tile = nullptr;
};

inline math::Ray ray_at(const RayStream& rays, size_t i) {
    return {{rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]},
            rays.t_min[i],
            {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]},
            rays.t_max[i]};
}

struct HitStream {
    float* t;
    float* u;
    float* v;
    uint32_t* triangle;  // kNoTriangle for a miss
    uint32_t* back_face; // 1 or 0
    uint32_t* steps;     // nodes visited by each ray's packet; null: not counted

    void store(size_t i, const Hit& hit) const {
        t[i] = hit.t;
        u[i] = hit.u;
        v[i] = hit.v;
        triangle[i] = hit.triangle;
        back_face[i] = hit.back_face;
        if (steps) steps[i] = hit.steps;
    }
};

// One table for each structure and instruction set; all of them give the same bits.
struct Kernels {
    Hit (*closest)(const Target& target, const math::Ray& ray, const Filter& filter);
    bool (*occluded)(const Target& target, const math::Ray& ray, const Filter& filter);
    void (*closest_stream)(const Target& target, const RayStream& rays, const Filter& filter,
                           const HitStream& hits);
    void (*occluded_stream)(const Target& target, const RayStream& rays, const Filter& filter,
                            uint8_t* occluded);
    // Shows the visitor every triangle that it wants to see; no filter.
    void (*visit)(const Target& target, const math::Ray& ray, Visitor& visitor);
    base::Isa isa; // never `best`
    const ShapeKernels* shapes = nullptr;
    const ShapeKernels* plain_shapes = nullptr; // these heed Watch::counters
};

// The table for an instruction set; null if this machine or build lacks it. `best` never fails.
// `compact` says of a BVH which one the targets have.
const Kernels* select_kernels(Structure structure, base::Isa isa, bool compact = false);

} // namespace peregrine::trace
