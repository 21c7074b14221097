#include "shade/light/tints.h"

#include "scene/alpha_test.h"
#include "shade/light/passage.h"
#include "trace/world/stream.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::shade {
namespace {

// The t >= 0 of a set of ways that may lie in a box.
struct Times {
    double begin = 0, end;

    // Along an axis, ways come from a place and go by `least` to `most` while t grows by one; the
    // box lies from `lower` to `upper` of that place.
    void cut(double lower, double upper, double least, double most) {
        keep_above(lower, most);
        keep_above(-upper, -least);
    }
    bool any() const { return begin <= end * (1 + 1e-5) + 1e-5; }

private:
    void keep_above(double bound, double rate) {
        if (rate > 0)
            begin = std::max(begin, bound / rate);
        else if (rate < 0)
            end = std::min(end, bound / rate);
        else if (bound > 0)
            end = -1;
    }
};

// Whether anything between the lamp and some of the points may lie in the box.
bool is_between(const math::Box& box, const PreparedLight& light, const math::Box& points) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool is_far = light.type == scene::LightType::directional;
    Times times{.end = is_far ? kInfinity : 1};
    for (int k = 0; k < 3; ++k) {
        const double radius = double(light.source_radius);
        const double lower = double(box.lower[k]), upper = double(box.upper[k]);
        const double first = double(points.lower[k]), last = double(points.upper[k]);
        if (is_far) {
            const double toward = -double(light.direction[k]);
            times.cut(lower - last, upper - first, toward - radius, toward + radius);
        } else {
            const double lamp = double(light.position[k]);
            times.cut(lower - lamp - radius, upper - lamp + radius, first - lamp - radius,
                      last - lamp + radius);
        }
    }
    return times.any();
}

// A ray that is asked whether it meets boxes between its ends.
struct BoxRay {
    math::Vec3d origin, inverse;
    double begin, end;

    explicit BoxRay(const math::Ray& ray)
        : origin(ray.origin), inverse(1.0 / math::Vec3d(ray.direction)), begin(ray.t_min),
          end(ray.t_max) {}

    bool meets(const math::Box& box) const {
        double near = begin, far = end;
        for (int k = 0; k < 3; ++k) {
            if (std::isinf(inverse[k])) {
                if (origin[k] < double(box.lower[k]) || origin[k] > double(box.upper[k]))
                    return false;
                continue;
            }
            const double a = (double(box.lower[k]) - origin[k]) * inverse[k];
            const double b = (double(box.upper[k]) - origin[k]) * inverse[k];
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        return near <= far;
    }
};

} // namespace

Tints::Tints(const scene::Snapshot& snapshot, const SurfaceSpace& space)
    : snapshot_(&snapshot), origin_(space.origin) {
    filter_.alpha = scene::alpha_test(snapshot);
}

// Lists the boxes of what light may pass that lie between the points and the lamp.
bool Tints::may_meet(const PreparedLight& light, const math::Box& points,
                     TintMemory& memory) const {
    memory.box_count = 0;
    for (const math::Box& in_world : snapshot_->light_passing) {
        const math::Box box = {math::Vec3(math::Vec3d(in_world.lower) - origin_),
                               math::Vec3(math::Vec3d(in_world.upper) - origin_)};
        if (is_between(box, light, points)) memory.boxes[memory.box_count++] = box;
    }
    return memory.box_count > 0;
}

// Of the rays that nothing opaque hides those that may pass something else.
uint32_t Tints::list(const trace::RayStream& rays, const Scratch& scratch,
                     TintMemory& memory) const {
    const ShadowMemory& shadow = scratch.shadow;
    uint32_t count = 0;
    for (uint32_t k = 0; k < rays.count; ++k) {
        if (shadow.occluded[k] == ShadowMemory::kOccluded
            || scratch.weights.diffuse[shadow.index[k]] == 0)
            continue;
        const BoxRay ray(ray_at(rays, k));
        if (std::none_of(memory.boxes, memory.boxes + memory.box_count,
                         [&](const math::Box& box) { return ray.meets(box); }))
            continue;
        for (int axis = 0; axis < 3; ++axis) {
            memory.origin[axis][count] = rays.origin[axis][k];
            memory.direction[axis][count] = rays.direction[axis][k];
        }
        memory.ray[count++] = k;
    }
    return count;
}

void Tints::take(const Shadows& shadows, const PreparedLight& light, uint32_t ray_count,
                 Scratch& scratch) const {
    TintMemory& memory = *scratch.tints;
    ShadowMemory& shadow = scratch.shadow;
    memory.count = 0;
    if (!may_meet(light, scratch.surface.bounds, memory)) return;
    trace::RayStream rays = shadows.list(light, ray_count, shadow);
    rays.count = list(rays, scratch, memory);
    if (rays.count == 0) return;
    for (int axis = 0; axis < 3; ++axis) {
        rays.origin[axis] = memory.origin[axis];
        rays.direction[axis] = memory.direction[axis];
    }
    shadow.ray_count += rays.count;
    const trace::Positions positions = shadows.positions_of(rays);
    rays = shadows.in_world(rays, shadow);
    trace::occluded(snapshot_->world, rays, positions, filter_, memory.meets);
    for (uint32_t i = 0; i < rays.count; ++i) {
        if (!memory.meets[i]) continue;
        const math::Vec3 tint = passage(*snapshot_, filter_, ray_at(rays, i), positions[i]);
        if (tint == math::Vec3(1)) continue;
        const uint32_t ray = memory.ray[i], point = shadow.index[ray];
        float& weight = scratch.weights.diffuse[point];
        memory.point[memory.count] = point;
        memory.weight[memory.count] = weight;
        memory.tint[memory.count++] = tint;
        weight = 0;
        shadow.occluded[ray] =
            tint == math::Vec3(0) ? ShadowMemory::kOccluded : ShadowMemory::kPenumbra;
    }
}

void Tints::give_back(const PreparedLight& light, Program program, Scratch& scratch) const {
    const TintMemory& memory = *scratch.tints;
    for (uint32_t i = 0; i < memory.count; ++i) {
        const uint32_t point = memory.point[i];
        scratch.weights.diffuse[point] = memory.weight[i]; // whoever marks points looks at it
        for (int k = 0; k < 3; ++k) {
            const float part = light.color[k] * memory.weight[i] * memory.tint[i][k];
            scratch.light.irradiance[k][point] += part;
            if (program != Program::matt)
                scratch.light.highlight[k][point] += part * scratch.weights.lobe[point];
        }
    }
}

} // namespace peregrine::shade
