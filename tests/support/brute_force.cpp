#include "support/brute_force.h"

#include "geometry/intersect.h"

#include <algorithm>
#include <limits>

namespace peregrine::test {
namespace {

constexpr size_t kBlock = 64;
constexpr size_t kTile = 1024; // triangles that stay in the cache while many rays meet them

struct Corners {
    const float* x;
    const float* y;
    const float* z;
};

// The float filter of geometry::intersect: 1 where it lets a triangle through. Returns whether it
// does anywhere: most blocks need no second look.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                                \
    && !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("avx2", "default")]]
#endif
int32_t
filter_block(const Corners (&corners)[3], const geometry::ShearedRay& ray, size_t count,
             int32_t* passes) {
    const float ox = ray.origin[ray.kx], oy = ray.origin[ray.ky], oz = ray.origin[ray.kz];
    const float sx = ray.sx, sy = ray.sy;
    const float *x0 = corners[0].x, *y0 = corners[0].y, *z0 = corners[0].z;
    const float *x1 = corners[1].x, *y1 = corners[1].y, *z1 = corners[1].z;
    const float *x2 = corners[2].x, *y2 = corners[2].y, *z2 = corners[2].z;
    int32_t any = 0;
    for (size_t i = 0; i < count; ++i) {
        const float az = z0[i] - oz, bz = z1[i] - oz, cz = z2[i] - oz;
        const float ax = (x0[i] - ox) - sx * az, ay = (y0[i] - oy) - sy * az;
        const float bx = (x1[i] - ox) - sx * bz, by = (y1[i] - oy) - sy * bz;
        const float cx = (x2[i] - ox) - sx * cz, cy = (y2[i] - oy) - sy * cz;
        const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        passes[i] = !(((u < 0) | (v < 0) | (w < 0)) & ((u > 0) | (v > 0) | (w > 0)));
        any |= passes[i];
    }
    return any;
}

} // namespace

BruteForce::BruteForce(std::span<const geometry::Triangle> triangles) : triangles_(triangles) {
    for (const auto& triangle : triangles)
        for (int axis = 0; axis < 3; ++axis) {
            corners_[0][axis].push_back(triangle.v0[axis]);
            corners_[1][axis].push_back(triangle.v1[axis]);
            corners_[2][axis].push_back(triangle.v2[axis]);
        }
}

void BruteForce::test_block(const math::Ray& ray, size_t first, const trace::Filter& filter,
                            trace::Hit& best) const {
    const geometry::ShearedRay sheared = geometry::shear(ray);
    const size_t count = std::min(kBlock, triangles_.size() - first);
    Corners corners[3];
    for (int v = 0; v < 3; ++v)
        corners[v] = {corners_[v][sheared.kx].data() + first,
                      corners_[v][sheared.ky].data() + first,
                      corners_[v][sheared.kz].data() + first};
    int32_t passes[kBlock];
    if (!filter_block(corners, sheared, count, passes)) return;
    for (size_t i = 0; i < count; ++i) {
        if (!passes[i]) continue;
        const geometry::Triangle& triangle = triangles_[first + i];
        geometry::TriangleHit hit;
        if (!geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)) continue;
        // At equal t a front goes before a back. Triangles come in order: of the rest the first
        // stays.
        const bool loses_tie = hit.back_face || !best.back_face;
        if (hit.t > best.t || (hit.t == best.t && loses_tie)
            || !filter.accepts(triangle.info(), hit.back_face, hit.u, hit.v))
            continue;
        best = {hit.t, hit.u, hit.v, uint32_t(first + i), hit.back_face, 0};
    }
}

void BruteForce::closest(std::span<const math::Ray> rays, const trace::Filter& filter,
                         trace::Hit* hits) const {
    for (size_t i = 0; i < rays.size(); ++i)
        hits[i] = {std::numeric_limits<float>::infinity(), 0, 0, geometry::kNoTriangle, false, 0};
    for (size_t tile = 0; tile < triangles_.size(); tile += kTile)
        for (size_t i = 0; i < rays.size(); ++i)
            for (size_t first = tile; first < std::min(tile + kTile, triangles_.size());
                 first += kBlock)
                test_block(rays[i], first, filter, hits[i]);
}

} // namespace peregrine::test
