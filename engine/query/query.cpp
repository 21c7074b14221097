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

uint64_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

// Magnitudes order as the integers that hold their bits, with infinity and NaN above all numbers.
constexpr uint64_t kMagnitude = 0x7fffffff;

uint64_t within(float value, float limit) {
    return (bits(value) & kMagnitude) <= bits(limit);
}

// Without branches but for the last: a single query spends more on this than on a few nodes
// otherwise.
bool is_valid(const math::Ray& ray) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const math::Vec3 &o = ray.origin, &d = ray.direction;
    const uint64_t origin =
        within(o.x, kLargestOrigin) & within(o.y, kLargestOrigin) & within(o.z, kLargestOrigin);
    const uint64_t direction =
        within(d.x, kLargestFloat) & within(d.y, kLargestFloat) & within(d.z, kLargestFloat);
    const uint64_t range = within(ray.t_min, kInfinity) & within(ray.t_max, kInfinity);
    const uint64_t length = (bits(d.x) | bits(d.y) | bits(d.z)) & kMagnitude;
    return (origin & direction & range) != 0 && length != 0;
}

[[noreturn, gnu::cold, gnu::noinline]] void reject(uint64_t index, const math::Ray& ray) {
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

// Field by field to where the host wants it: a record put together elsewhere and copied would wait
// for its own stores.
void store_hit(const scene::Snapshot& snapshot, const trace::Hit& hit, std::byte* place) {
    const auto store = [place](size_t offset, auto value) {
        std::memcpy(place + offset, &value, sizeof value);
    };
    const bool missed = hit.triangle == geometry::kNoTriangle;
    const geometry::TriangleInfo* triangle =
        missed ? nullptr : snapshot.target.infos + hit.triangle;
    store(offsetof(Hit, t), hit.t);
    store(offsetof(Hit, u), hit.u);
    store(offsetof(Hit, v), hit.v);
    store(offsetof(Hit, triangle), missed ? geometry::kNoTriangle : uint32_t(triangle->primitive));
    store(offsetof(Hit, mesh) + offsetof(base::Handle, index), missed ? 0u : triangle->mesh);
    store(offsetof(Hit, mesh) + offsetof(base::Handle, generation),
          missed ? 0u : snapshot.meshes[triangle->mesh].generation);
    store(offsetof(Hit, instance), 0u);
    store(offsetof(Hit, back_face), uint32_t(hit.back_face));
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

void closest_hit(const scene::Snapshot& snapshot, const math::Ray& ray, std::byte* place) {
    static constexpr trace::Filter kEverything;
    store_hit(snapshot, snapshot.kernels->closest(snapshot.target, ray, kEverything), place);
}

bool occluded(const scene::Snapshot& snapshot, const math::Ray& ray) {
    static constexpr trace::Filter kEverything;
    return snapshot.kernels->occluded(snapshot.target, ray, kEverything);
}

void closest_hits(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
                  const Selection& selection, const Strided<Hit>& hits) {
    const trace::Filter filter = make_filter(snapshot, selection);
    for (uint64_t i = 0; i < rays.count; ++i)
        store_hit(snapshot, snapshot.kernels->closest(snapshot.target, rays.load(i), filter),
                  hits.data + i * hits.stride);
}

void occlusion(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
               const Selection& selection, const Strided<uint8_t>& occluded) {
    const trace::Filter filter = make_filter(snapshot, selection);
    for (uint64_t i = 0; i < rays.count; ++i)
        occluded.store(i, snapshot.kernels->occluded(snapshot.target, rays.load(i), filter));
}

} // namespace peregrine::query
