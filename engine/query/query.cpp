#include "query/query.h"

#include "base/error.h"
#include "scene/alpha_test.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

namespace peregrine::query {
namespace {

constexpr float kLargestOrigin = 1e30f;
constexpr float kLargestFloat = std::numeric_limits<float>::max();

// Four lanes, compared at once: a single query spends more on this than on a few nodes otherwise.
using Float4 = float [[gnu::vector_size(16)]];
using Int4 = int32_t [[gnu::vector_size(16)]];

Int4 at_most(const float* values, const Float4& limits) {
    Float4 v;
    std::memcpy(&v, values, sizeof v);
    return Int4(v <= limits) & Int4(v >= -limits); // NaN compares false
}

bool is_valid(const math::Ray& ray) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Int4 in_range =
        at_most(&ray.origin.x, Float4{kLargestOrigin, kLargestOrigin, kLargestOrigin, kInfinity})
        & at_most(&ray.direction.x, Float4{kLargestFloat, kLargestFloat, kLargestFloat, kInfinity});
    uint64_t halves[2];
    std::memcpy(halves, &in_range, sizeof halves);
    const uint32_t direction = std::bit_cast<uint32_t>(ray.direction.x)
                               | std::bit_cast<uint32_t>(ray.direction.y)
                               | std::bit_cast<uint32_t>(ray.direction.z);
    return ((halves[0] & halves[1]) == ~uint64_t(0)) & (direction << 1 != 0); // -0 is 0 as well
}
static_assert(offsetof(math::Ray, t_min) == offsetof(math::Ray, origin) + 12);
static_assert(offsetof(math::Ray, t_max) == offsetof(math::Ray, direction) + 12);

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

void check_ray(const math::Ray& ray) {
    if (!is_valid(ray)) [[unlikely]]
        reject(0, ray);
}

Hit closest_hit(const scene::Snapshot& snapshot, const math::Ray& ray) {
    static constexpr trace::Filter kEverything;
    return to_host(snapshot, snapshot.kernels->closest(snapshot.target, ray, kEverything));
}

bool occluded(const scene::Snapshot& snapshot, const math::Ray& ray) {
    static constexpr trace::Filter kEverything;
    return snapshot.kernels->occluded(snapshot.target, ray, kEverything);
}

void closest_hits(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
                  const Selection& selection, const Strided<Hit>& hits) {
    const trace::Filter filter = make_filter(snapshot, selection);
    for (uint64_t i = 0; i < rays.count; ++i)
        hits.store(
            i, to_host(snapshot, snapshot.kernels->closest(snapshot.target, rays.load(i), filter)));
}

void occlusion(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
               const Selection& selection, const Strided<uint8_t>& occluded) {
    const trace::Filter filter = make_filter(snapshot, selection);
    for (uint64_t i = 0; i < rays.count; ++i)
        occluded.store(i, snapshot.kernels->occluded(snapshot.target, rays.load(i), filter));
}

} // namespace peregrine::query
