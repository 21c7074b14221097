#include "gameplay/world.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace peregrine::gameplay {
namespace {

void require(const rt_api& api, rt_result result) {
    if (result != RT_OK) throw std::runtime_error(api.get_last_error());
}

void store(const Vec3& from, float* to) {
    for (int k = 0; k < 3; ++k) to[k] = float(from[k]);
}

Vec3 load(const float* from) {
    return {from[0], from[1], from[2]};
}

// Records are relative to the origin, and so as precise far away as near.
rt_query_options options(const Vec3& origin, const Mask& mask) {
    rt_query_options options = rt_default_query_options();
    for (int k = 0; k < 3; ++k) options.origin[k] = origin[k];
    options.ignore_meshes = mask.ignored.data();
    options.ignore_count = mask.ignored.size();
    return options;
}

// A segment from the options' origin.
rt_ray segment(const Vec3& motion) {
    rt_ray ray{};
    store(motion, ray.direction);
    ray.t_max = 1;
    return ray;
}

} // namespace

std::optional<Contact> World::sweep(const Capsule& shape, const Vec3& motion, const Mask& mask,
                                    bool leaving) const {
    rt_sweep sweep{};
    store(motion, sweep.direction);
    if (load(sweep.direction) == Vec3(0)) return std::nullopt;
    store(shape.axis, sweep.axis);
    sweep.radius = float(shape.radius);
    sweep.t_max = 1;

    const rt_query_options asked = options(shape.center, mask);
    rt_sweep_hit hit;
    rt_sweep_desc desc = rt_default_sweep_desc();
    desc.sweeps = &sweep;
    desc.sweep_count = 1;
    desc.hits = &hit;
    desc.layer_mask = mask.layers;
    desc.flags = leaving ? uint32_t(RT_QUERY_SKIP_SEPARATING) : 0;
    desc.options = &asked;
    require(*api_, api_->sweep_shapes(scene_, &desc));
    if (hit.triangle == RT_NO_TRIANGLE) return std::nullopt;
    return Contact{hit.t,       shape.center + load(hit.point), load(hit.normal),
                   hit.depth,   hit.initial_contact != 0,       hit.mesh,
                   hit.triangle};
}

std::optional<RayHit> World::closest(const Vec3& from, const Vec3& motion, const Mask& mask) const {
    const rt_ray ray = segment(motion);
    if (load(ray.direction) == Vec3(0)) return std::nullopt;
    const rt_query_options asked = options(from, mask);
    rt_hit hit;
    rt_surface surface;
    rt_query_desc desc = rt_default_query_desc();
    desc.rays = &ray;
    desc.ray_count = 1;
    desc.hits = &hit;
    desc.surfaces = &surface;
    desc.surface_fields = RT_SURFACE_GEOMETRIC_NORMAL;
    desc.layer_mask = mask.layers;
    desc.options = &asked;
    require(*api_, api_->trace_query(scene_, &desc));
    if (hit.triangle == RT_NO_TRIANGLE) return std::nullopt;
    const Vec3 normal = load(surface.geometric_normal);
    return RayHit{hit.t, from + motion * double(hit.t), hit.back_face ? -normal : normal, hit.mesh,
                  hit.triangle};
}

void World::any(const Vec3& origin, std::span<const rt_ray> rays, const Mask& mask,
                std::span<uint8_t> occluded) const {
    const rt_query_options asked = options(origin, mask);
    rt_query_desc desc = rt_default_query_desc();
    desc.kind = RT_QUERY_ANY;
    desc.rays = rays.data();
    desc.ray_count = rays.size();
    desc.occluded = occluded.data();
    desc.layer_mask = mask.layers;
    desc.options = &asked;
    require(*api_, api_->trace_query(scene_, &desc));
}

bool World::is_free(const Vec3& from, const Vec3& to, const Mask& mask) const {
    const rt_ray ray = segment(to - from);
    if (load(ray.direction) == Vec3(0)) return true;
    uint8_t occluded = 0;
    any(from, {&ray, 1}, mask, {&occluded, 1});
    return !occluded;
}

bool World::overlaps(const Capsule& shape, const Mask& mask) const {
    rt_shape record{};
    record.kind = RT_SHAPE_CAPSULE;
    record.radius = float(shape.radius);
    store(shape.axis, record.extent);
    return overlaps(shape.center, record, mask);
}

bool World::overlaps(const Box& shape, const Mask& mask) const {
    rt_shape record{};
    record.kind = RT_SHAPE_BOX;
    store(shape.half_size, record.extent);
    for (int k = 0; k < 4; ++k) record.rotation[k] = float(shape.rotation[k]);
    return overlaps(shape.center, record, mask);
}

bool World::overlaps(const Vec3& origin, const rt_shape& shape, const Mask& mask) const {
    const rt_query_options asked = options(origin, mask);
    uint8_t overlapping = 0;
    rt_overlap_desc desc = rt_default_overlap_desc();
    desc.shapes = &shape;
    desc.shape_count = 1;
    desc.overlapping = &overlapping;
    desc.layer_mask = mask.layers;
    desc.options = &asked;
    require(*api_, api_->overlap_shapes(scene_, &desc));
    return overlapping != 0;
}

std::optional<Nearest> World::nearest(const Vec3& point, double radius, const Mask& mask) const {
    const rt_point record{{0, 0, 0}, float(radius)};
    const rt_query_options asked = options(point, mask);
    rt_nearest found;
    rt_nearest_desc desc = rt_default_nearest_desc();
    desc.points = &record;
    desc.point_count = 1;
    desc.results = &found;
    desc.layer_mask = mask.layers;
    desc.options = &asked;
    require(*api_, api_->find_nearest(scene_, &desc));
    if (found.triangle == RT_NO_TRIANGLE) return std::nullopt;
    return Nearest{found.distance, point + load(found.point), load(found.normal), found.mesh,
                   found.triangle};
}

void World::lines_of_sight(const Vec3& origin, std::span<const Vec3> from, std::span<const Vec3> to,
                           const Mask& mask, std::span<uint8_t> clear) const {
    std::vector<rt_ray> rays;
    std::vector<size_t> places; // of the rays; where from and to fall together, nothing is between
    rays.reserve(from.size());
    places.reserve(from.size());
    for (size_t i = 0; i < from.size(); ++i) {
        clear[i] = 1;
        rt_ray ray = segment(to[i] - from[i]);
        store(from[i] - origin, ray.origin);
        if (load(ray.direction) == Vec3(0)) continue;
        rays.push_back(ray);
        places.push_back(i);
    }
    std::vector<uint8_t> occluded(rays.size());
    any(origin, rays, mask, occluded);
    for (size_t k = 0; k < places.size(); ++k) clear[places[k]] = !occluded[k];
}

} // namespace peregrine::gameplay
