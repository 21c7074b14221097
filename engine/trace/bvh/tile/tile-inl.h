// The primary rays of a tile of the image. Included once for each instruction set, where a vector
// has eight floats.
#if defined(PEREGRINE_TRACE_BVH_TILE_TILE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PEREGRINE_TRACE_BVH_TILE_TILE_INL_H
#undef PEREGRINE_TRACE_BVH_TILE_TILE_INL_H
#else
#define PEREGRINE_TRACE_BVH_TILE_TILE_INL_H
#endif

#include <hwy/highway.h>

#include "geometry/intersect.h"
#include "math/vec.h"
#include "simd/lanes-inl.h"
#include "simd/transpose-inl.h"
#include "trace/kernels.h"
#include "trace/slabs.h"

#include <algorithm>
#include <array>
#include <cmath>

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
HWY_BEFORE_NAMESPACE();
namespace peregrine::trace::bvh::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

// Groups are blocks of 8x8 pixels, along Morton's curve as the rays; a group's rays go in eights,
// 4x2 pixels.
inline constexpr uint32_t kTileRays = ImageTile::kSide * ImageTile::kSide;
inline constexpr uint32_t kTileGroups = 16;
inline constexpr uint32_t kTileGroupRays = kTileRays / kTileGroups;
inline constexpr uint32_t kAllTileGroups = (1u << kTileGroups) - 1;

// Slopes of a tile count from its centre in halves of its side: pixel i of a row has p = (i - 15.5)
// / 16, and from pixel to pixel it is a sixteenth.
constexpr float slope_of_pixel(float i) {
    return (i - 15.5f) * 0.0625f;
}
inline constexpr float kPixelSlope = 0.0625f;

// The bits of groups in a set of columns, or of rows, of the four that there are.
struct GroupBits {
    std::array<uint16_t, 16> of_columns{}, of_rows{};
    constexpr GroupBits() {
        for (uint32_t g = 0; g < kTileGroups; ++g)
            for (uint32_t set = 0; set < 16; ++set) {
                if (set >> column(g) & 1) of_columns[set] |= uint16_t(1u << g);
                if (set >> row(g) & 1) of_rows[set] |= uint16_t(1u << g);
            }
    }
    static constexpr uint32_t column(uint32_t g) { return (g & 1) | (g >> 1 & 2); }
    static constexpr uint32_t row(uint32_t g) { return (g >> 1 & 1) | (g >> 2 & 2); }
};
inline constexpr GroupBits kGroupBits;

// A tile as a frame of reference: with R and D the directions by half a tile to the right and down,
// and C the direction through its centre, V = X R + Y D + Z C is a point relative to the origin.
// The ray with slopes (p, q) is at (p t, q t, t) for each t, so Z is also what hits are ordered by.
//
// How far off is that, in units of e = 2^-24? A ray's direction is rounded: it is off by 4 S, S
// being the largest sum of what it is made from. A hit at t is within 8.1 D of a point P of its
// triangle (geometry/intersect.h), where D is the largest |coordinate| of a vertex, all relative to
// the origin; so t is at most 1.01 D / |d|, and the point at t of the ray as it ought to be is
// within
//     8.2 D + 4.1 S D / |d| <= (8.2 + 4.1 k) D,   k = S / the least |d|_inf of the tile,
// of P. X is off by that times m = |row of X|_1, and so on.
struct Tile {
    int kx, ky, kz;    // the axes of geometry::shear for all rays
    math::Vec3 origin; // of all
    float row[3][3];   // of X, Y and Z: by axis of the world
    float size[3];     // m: sums of their absolute values
    float start[3];    // what they are at the world's origin
    float box_margin[3];
    size_t first[3][3]; // the plane of a node, in floats, where a row is least on an axis
    float drift;        // e k; see above
    float across[2];    // |R|_inf, |D|_inf
    float direction;    // S / |det(R, D, C)|
    bool mirrored;      // det(R, D, C) < 0

    // sx and sy of geometry::shear.
    alignas(64) float sx[kTileRays], sy[kTileRays];
    alignas(64) float group_limit[kTileGroups]; // the largest t that rays still want, ...
    float limit;                                // ... and that of all groups

    // False if the kernels for a tile had better not take these rays.
    HWY_ATTR bool gather(const Target& target, const RayStream& rays);

    // After hits of rays in `groups`, given the t of all rays.
    HWY_INLINE HWY_ATTR void update_limits(uint32_t groups, const float* t);

    // Groups of `mask` that can still be hit at z or beyond.
    HWY_INLINE HWY_ATTR uint32_t reaching(uint32_t mask, float z) const {
        const V8 at = hn::Set(k8, z);
        return (bits_of(k8, hn::Ge(hn::Load(k8, group_limit), at))
                | bits_of(k8, hn::Ge(hn::Load(k8, group_limit + 8), at)) << 8)
               & mask;
    }

private:
    bool place(const Target& target, const ImageTile& image);
    HWY_ATTR bool gather_slopes(const RayStream& rays);
};

inline float largest_of(const math::Vec3d& v) {
    return float(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}));
}

inline bool Tile::place(const Target& target, const ImageTile& image) {
    using math::Vec3d;
    constexpr float kE = 0x1p-24f;
    const Vec3d right = 16.0 * Vec3d(image.right), down = 16.0 * Vec3d(image.down);
    const Vec3d center = Vec3d(image.corner) + Vec3d(image.right) * (image.x + 16.0)
                         + Vec3d(image.down) * (image.y + 16.0);
    const double det = glm::dot(right, glm::cross(down, center));
    const Vec3d rows[3] = {glm::cross(down, center) / det, glm::cross(center, right) / det,
                           glm::cross(right, down) / det};
    across[0] = largest_of(right);
    across[1] = largest_of(down);
    const float sum =
        largest_of(glm::abs(Vec3d(image.corner)) + glm::abs(Vec3d(image.right)) * (image.x + 32.0)
                   + glm::abs(Vec3d(image.down)) * (image.y + 32.0))
        * 1.001f;
    const float least = largest_of(center) - (across[0] + across[1]) * 1.001f;
    const float distance = reach<float>(target.bounds, origin);
    // Where k is small and no product of three lengths leaves the normal range of float.
    if (!(least * 64 >= sum && sum >= 0x1p-8f && sum <= 0x1p8f && distance >= 0x1p-16f
          && distance <= 0x1p20f && across[0] >= 0x1p-16f && across[1] >= 0x1p-16f))
        return false;
    drift = kE * 4.5f * (sum / least);
    direction = float(double(sum) / std::fabs(det)) * 1.001f;
    mirrored = det < 0;
    for (int i = 0; i < 3; ++i) {
        size[i] = 0;
        double at_origin = 0;
        for (int k = 0; k < 3; ++k) {
            row[i][k] = float(rows[i][k]);
            size[i] += std::fabs(row[i][k]) * 1.001f;
            at_origin -= double(row[i][k]) * double(origin[k]);
            first[i][k] = (size_t(k) + (row[i][k] < 0 ? 3 : 0)) * accel::bvh::kWidth;
        }
        start[i] = float(at_origin);
    }
    // The rounding of a row makes D, the three sums of TileChildren::range 3 D + 7 |o|, and the
    // products with slopes there Z.
    const float rounding = kE * 8.0f * (distance + largest_component(origin));
    for (int i = 0; i < 3; ++i)
        box_margin[i] = (size[i] + size[2]) * ((drift + kE * 8.5f) * distance + rounding);
    return size[0] <= 0x1p20f && size[1] <= 0x1p20f && size[2] <= 0x1p10f;
}

// Slopes as the canonical test has them; false where two rays have different main axes.
inline HWY_ATTR bool Tile::gather_slopes(const RayStream& rays) {
    V8 steepest = hn::Zero(k8);
    for (uint32_t i = 0; i < kTileRays; i += kLanes8) {
        const V8 dz = hn::Load(k8, rays.direction[kz] + i);
        const V8 x = hn::Div(hn::Load(k8, rays.direction[kx] + i), dz);
        const V8 y = hn::Div(hn::Load(k8, rays.direction[ky] + i), dz);
        hn::Store(x, k8, sx + i);
        hn::Store(y, k8, sy + i);
        steepest = hn::Max(steepest, hn::Max(hn::Abs(x), hn::Abs(y)));
    }
    return hn::AllTrue(k8, hn::Lt(steepest, hn::Set(k8, 1.0f)));
}

// Eight groups at a time: a lane of `column` is a group's.
HWY_INLINE HWY_ATTR void Tile::update_limits(uint32_t groups, const float* t) {
    for (uint32_t first = 0; first < kTileGroups; first += 8) {
        if ((groups >> first & 255) == 0) continue;
        V8 row[8], column[8];
        for (uint32_t g = 0; g < 8; ++g) {
            const float* const of_group = t + (first + g) * kTileGroupRays;
            row[g] = hn::Load(k8, of_group);
            for (uint32_t i = 8; i < kTileGroupRays; i += 8)
                row[g] = hn::Max(row[g], hn::Load(k8, of_group + i));
        }
        transpose(row, column);
        for (uint32_t i = 1; i < 8; ++i) column[0] = hn::Max(column[0], column[i]);
        hn::Store(column[0], k8, group_limit + first);
    }
    const V8 most = hn::Max(hn::Load(k8, group_limit), hn::Load(k8, group_limit + 8));
    limit = hn::GetLane(hn::MaxOfLanes(k8, most));
}

inline HWY_ATTR bool Tile::gather(const Target& target, const RayStream& rays) {
    const math::Ray ray = ray_at(rays, 0);
    origin = ray.origin;
    const geometry::Axes axes = geometry::axes_of(ray.direction);
    kx = axes.kx, ky = axes.ky, kz = axes.kz;
    if (!place(target, *rays.tile) || !gather_slopes(rays)) return false;
    limit = std::numeric_limits<float>::max();
    std::fill_n(group_limit, kTileGroups, limit);
    return true;
}

} // namespace peregrine::trace::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
#endif
