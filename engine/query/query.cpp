#include "query/query.h"

#include "base/error.h"
#include "scene/alpha_test.h"

#include <cmath>
#include <limits>

namespace peregrine::query {
namespace {

constexpr float kLargestOrigin = 1e30f;
constexpr float kLargestFloat = std::numeric_limits<float>::max();

// 1 or 0; a comparison with NaN is false. Numbers instead of bools: one branch a ray, not eleven.
uint32_t within(float x, float limit) {
    return std::fabs(x) <= limit;
}

bool is_valid(const math::Ray& ray) {
    const math::Vec3 &o = ray.origin, &d = ray.direction;
    const uint32_t origin =
        within(o.x, kLargestOrigin) & within(o.y, kLargestOrigin) & within(o.z, kLargestOrigin);
    const uint32_t direction =
        within(d.x, kLargestFloat) & within(d.y, kLargestFloat) & within(d.z, kLargestFloat);
    const uint32_t length = uint32_t(d.x != 0) | uint32_t(d.y != 0) | uint32_t(d.z != 0);
    const uint32_t range = uint32_t(ray.t_min == ray.t_min) & uint32_t(ray.t_max == ray.t_max);
    return (origin & direction & length & range) != 0;
}

[[noreturn]] void reject(uint64_t index, const math::Ray& ray) {
    const char* names[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
        if (!(std::fabs(ray.origin[k]) <= kLargestOrigin))
            base::fail(base::Code::invalid_argument,
                       "ray %llu: origin %s is %g; it must be finite and at most 1e30 in magnitude",
                       static_cast<unsigned long long>(index), names[k], double(ray.origin[k]));
        if (!(std::fabs(ray.direction[k]) <= kLargestFloat))
            base::fail(base::Code::invalid_argument,
                       "ray %llu: direction %s is %g; it must be finite",
                       static_cast<unsigned long long>(index), names[k], double(ray.direction[k]));
    }
    if (std::isnan(ray.t_min) || std::isnan(ray.t_max))
        base::fail(base::Code::invalid_argument, "ray %llu: %s is NaN",
                   static_cast<unsigned long long>(index),
                   std::isnan(ray.t_min) ? "t_min" : "t_max");
    base::fail(base::Code::invalid_argument, "ray %llu: the direction is zero",
               static_cast<unsigned long long>(index));
}

trace::Filter make_filter(const scene::Snapshot& snapshot, const Selection& selection) {
    trace::Filter filter;
    filter.faces = selection.faces;
    filter.layer_mask = selection.layer_mask;
    filter.layer_masks = snapshot.layer_masks.data();
    const base::Handle ignored = selection.ignore_mesh;
    if (ignored && ignored.index < snapshot.meshes.size()
        && snapshot.meshes[ignored.index].generation == ignored.generation)
        filter.ignore_mesh = ignored.index;
    if (selection.alpha_test && (snapshot.features & scene::kAlphaMask))
        filter.alpha = scene::alpha_test(snapshot);
    return filter;
}

Hit to_host(const scene::Snapshot& snapshot, const trace::Hit& hit) {
    if (hit.triangle == geometry::kNoTriangle)
        return {hit.t, 0, 0, geometry::kNoTriangle, {}, 0, 0};
    const geometry::Triangle& triangle = snapshot.geometry->triangles[hit.triangle];
    return {hit.t,
            hit.u,
            hit.v,
            triangle.primitive,
            {triangle.mesh, snapshot.meshes[triangle.mesh].generation},
            0,
            hit.back_face};
}

} // namespace

void check_rays(const Strided<math::Ray>& rays) {
    for (uint64_t i = 0; i < rays.count; ++i) {
        const math::Ray ray = rays.load(i);
        if (!is_valid(ray)) [[unlikely]]
            reject(i, ray);
    }
}

void closest_hits(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
                  const Selection& selection, const Strided<Hit>& hits) {
    const trace::Filter filter = make_filter(snapshot, selection);
    const trace::Target target = snapshot.target();
    for (uint64_t i = 0; i < rays.count; ++i)
        hits.store(i, to_host(snapshot, snapshot.kernels->closest(target, rays.load(i), filter)));
}

void occlusion(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
               const Selection& selection, const Strided<uint8_t>& occluded) {
    const trace::Filter filter = make_filter(snapshot, selection);
    const trace::Target target = snapshot.target();
    for (uint64_t i = 0; i < rays.count; ++i)
        occluded.store(i, snapshot.kernels->occluded(target, rays.load(i), filter));
}

} // namespace peregrine::query
