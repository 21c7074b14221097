#include "support/brute_force.h"

#include "geometry/intersect.h"

#include <algorithm>
#include <limits>

namespace peregrine::test {
namespace {

constexpr size_t kBlock = 256;

struct Corners {
    const float* x;
    const float* y;
    const float* z;
};

// The float filter of geometry::intersect: 1 where it lets a triangle through.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                                \
    && !defined(__SANITIZE_ADDRESS__)
[[gnu::target_clones("avx2", "default")]]
#endif
void filter_block(const Corners (&corners)[3], const geometry::ShearedRay& ray, size_t count,
                  int32_t* passes) {
    const float ox = ray.origin[ray.kx], oy = ray.origin[ray.ky], oz = ray.origin[ray.kz];
    const float sx = ray.sx, sy = ray.sy;
    const float *x0 = corners[0].x, *y0 = corners[0].y, *z0 = corners[0].z;
    const float *x1 = corners[1].x, *y1 = corners[1].y, *z1 = corners[1].z;
    const float *x2 = corners[2].x, *y2 = corners[2].y, *z2 = corners[2].z;
    for (size_t i = 0; i < count; ++i) {
        const float az = z0[i] - oz, bz = z1[i] - oz, cz = z2[i] - oz;
        const float ax = (x0[i] - ox) - sx * az, ay = (y0[i] - oy) - sy * az;
        const float bx = (x1[i] - ox) - sx * bz, by = (y1[i] - oy) - sy * bz;
        const float cx = (x2[i] - ox) - sx * cz, cy = (y2[i] - oy) - sy * cz;
        const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        passes[i] = !(((u < 0) | (v < 0) | (w < 0)) & ((u > 0) | (v > 0) | (w > 0)));
    }
}

bool precedes(const geometry::Triangle& a, const geometry::Triangle& b) {
    return a.mesh != b.mesh ? a.mesh < b.mesh : a.primitive < b.primitive;
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

template <class Visit>
void BruteForce::visit_candidates(const math::Ray& ray, Visit&& visit) const {
    const geometry::ShearedRay sheared = geometry::shear(ray);
    int32_t passes[kBlock];
    for (size_t first = 0; first < triangles_.size(); first += kBlock) {
        const size_t count = std::min(kBlock, triangles_.size() - first);
        Corners corners[3];
        for (int v = 0; v < 3; ++v)
            corners[v] = {corners_[v][sheared.kx].data() + first,
                          corners_[v][sheared.ky].data() + first,
                          corners_[v][sheared.kz].data() + first};
        filter_block(corners, sheared, count, passes);
        for (size_t i = 0; i < count; ++i) {
            if (!passes[i]) continue;
            const geometry::Triangle& triangle = triangles_[first + i];
            geometry::TriangleHit hit;
            if (geometry::intersect(sheared, triangle.v0, triangle.v1, triangle.v2, hit)
                && visit(triangle, hit))
                return;
        }
    }
}

trace::Hit BruteForce::closest(const math::Ray& ray, const trace::Filter& filter) const {
    trace::Hit best{std::numeric_limits<float>::infinity(), 0, 0, geometry::kNoTriangle, false, 0};
    visit_candidates(ray, [&](const geometry::Triangle& triangle, const auto& hit) {
        if (hit.t > best.t || !filter.accepts(triangle, hit.back_face, hit.u, hit.v)) return false;
        if (hit.t == best.t && !precedes(triangle, triangles_[best.triangle])) return false;
        best = {hit.t, hit.u, hit.v, uint32_t(&triangle - triangles_.data()), hit.back_face, 0};
        return false;
    });
    return best;
}

bool BruteForce::occluded(const math::Ray& ray, const trace::Filter& filter) const {
    bool found = false;
    visit_candidates(ray, [&](const geometry::Triangle& triangle, const auto& hit) {
        return found = filter.accepts(triangle, hit.back_face, hit.u, hit.v);
    });
    return found;
}

} // namespace peregrine::test
