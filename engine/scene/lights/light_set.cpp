#include "scene/lights/light_set.h"

#include "accel/spheres/builder.h"

#include <algorithm>
#include <cmath>

namespace peregrine::scene {
namespace {

using accel::spheres::Sphere;

constexpr uint32_t kFew = 32; // lights: asked one by one, they take less than a tree

float largest_coordinate(const math::Vec3d& p) {
    return float(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}));
}

// Around all places that reaches() says the light may reach, also if position and places were moved
// by some origin and rounded: the margins cover its own margin and the rounding of the position.
Sphere sphere_of(const Light& light) {
    const float rounding = largest_coordinate(light.position) * 0x1p-21f;
    return {math::Vec3(light.position),
            std::max(end_of(light) * 1.001f + rounding, accel::spheres::kSmallest)};
}

bool fits_tree(const Sphere& sphere) {
    const math::Vec3 most = glm::abs(sphere.center);
    return sphere.radius <= accel::spheres::kLargest
           && std::max({most.x, most.y, most.z}) <= accel::spheres::kLargest;
}

void build_tree(LightSet& set, base::Scheduler& scheduler, base::Memory* memory) {
    const auto count = uint32_t(set.lights.size());
    base::Vector<Sphere> spheres(memory);
    base::Vector<uint32_t> items(memory);
    if (count > kFew) {
        spheres.reserve(count);
        items.reserve(count);
    }
    for (uint32_t i = 0; i < count; ++i) {
        const Sphere sphere = sphere_of(set.lights[i]);
        const bool has_end = set.lights[i].type != LightType::directional && fits_tree(sphere);
        if (!has_end || count <= kFew) {
            set.beside.push_back(i);
            continue;
        }
        spheres.push_back(sphere);
        items.push_back(i);
    }
    accel::spheres::build(spheres, items, scheduler, memory, set.tree);
}

} // namespace

bool LightSet::is_of(const base::Vector<Light>& others, const LightViews& other_views,
                     const math::Box& bounds) const {
    if (lights != others || views != other_views) return false;
    for (size_t i = 0; i < lights.size(); ++i)
        if (is_near(lights[i], bounds) != prepared[i].from_light) return false;
    return true;
}

std::shared_ptr<const LightSet> make_light_set(base::Vector<Light> lights, LightViews views,
                                               const math::Box& bounds, base::Scheduler& scheduler,
                                               base::Memory* memory) {
    const auto set =
        std::allocate_shared<LightSet>(std::pmr::polymorphic_allocator<LightSet>(memory), memory);
    set->lights = std::move(lights);
    set->views = std::move(views);
    set->prepared.reserve(set->lights.size());
    for (size_t i = 0; i < set->lights.size(); ++i) {
        PreparedLight& light = set->prepared.emplace_back(prepare(set->lights[i], bounds));
        // Proofs are of points.
        const bool is_point = light.source_radius == 0;
        if (!set->views.empty() && is_point) light.visibility = set->views[i].get();
        if (light.fog_scatter > 0) set->in_fog.push_back(uint32_t(i));
        if (light.from_light)
            set->largest_radius = std::max(set->largest_radius, light.radius + light.source_radius);
    }
    build_tree(*set, scheduler, memory);
    return set;
}

} // namespace peregrine::scene
