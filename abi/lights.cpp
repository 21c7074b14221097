#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene_table.h"

#include "shade/light/sphere_points.h"

#include <cmath>
#include <limits>

namespace peregrine::abi {
namespace {

void check_cone(const rt_light_desc& desc) {
    const float inner = desc.cone_inner_cos;
    const float outer = desc.cone_outer_cos;
    if (outer < -1 || outer > inner || inner > 1)
        base::fail(base::Code::invalid_argument,
                   "rt_light_desc: cone_inner_cos is %g and cone_outer_cos %g; "
                   "-1 <= outer <= inner <= 1 must hold",
                   double(inner), double(outer));
}

// Infinity means no end. The paper's fall-offs are functions of distance / radius and need one.
void check_radius(const rt_light_desc& desc) {
    const bool inverse_square = desc.falloff == RT_FALLOFF_WINDOWED_INVERSE_SQUARE
                                || desc.falloff == RT_FALLOFF_INVERSE_SQUARE;
    const bool directional = desc.type == RT_LIGHT_DIRECTIONAL;
    if (desc.radius == std::numeric_limits<float>::infinity()) {
        if (inverse_square || directional) return;
        base::fail(base::Code::invalid_argument,
                   "rt_light_desc.radius is infinite, but a falloff of %d needs an end",
                   desc.falloff);
    }
    require_finite(desc.radius, "rt_light_desc.radius");
    if (!directional) require_positive(desc.radius, "rt_light_desc.radius");
}

// Seen in fog is what is near a place.
void check_fog_scatter(const rt_light_desc& desc) {
    if (!(desc.fog_scatter >= 0 && desc.fog_scatter <= 1))
        base::fail(base::Code::invalid_argument,
                   "rt_light_desc.fog_scatter is %g; it must be 0 to 1", double(desc.fog_scatter));
    if (desc.fog_scatter > 0
        && (desc.type == RT_LIGHT_DIRECTIONAL
            || desc.radius == std::numeric_limits<float>::infinity()))
        base::fail(base::Code::invalid_argument,
                   "rt_light_desc.fog_scatter is %g, but the light is directional or has no end",
                   double(desc.fog_scatter));
}

// NaN is refused in every field, ranges only where the type of light reads them.
void check(const rt_light_desc& desc) {
    require_enum(desc.type, RT_LIGHT_DIRECTIONAL, "rt_light_desc.type");
    require_finite(std::span<const double>(desc.position), "rt_light_desc.position");
    require_finite(std::span<const float>(desc.direction), "rt_light_desc.direction");
    require_colour(desc.intensity, "rt_light_desc.intensity");
    require_finite(desc.cone_inner_cos, "rt_light_desc.cone_inner_cos");
    require_finite(desc.cone_outer_cos, "rt_light_desc.cone_outer_cos");
    require_flag(desc.casts_no_shadow, "rt_light_desc.casts_no_shadow");
    require_enum(desc.falloff, RT_FALLOFF_INVERSE_SQUARE, "rt_light_desc.falloff");
    check_fog_scatter(desc);
    require_least_zero(desc.source_radius, "rt_light_desc.source_radius");
    if (desc.shadow_samples > shade::kMostSpherePoints)
        base::fail(base::Code::invalid_argument,
                   "rt_light_desc.shadow_samples is %u; at most %u are taken", desc.shadow_samples,
                   shade::kMostSpherePoints);
    check_radius(desc);
    if (desc.type != RT_LIGHT_POINT) require_direction(desc.direction, "rt_light_desc.direction");
    if (desc.type == RT_LIGHT_SPOT) check_cone(desc);
}

// In double, where the square of no float over- or underflows.
math::Vec3 unit(const float (&v)[3]) {
    const double x = v[0], y = v[1], z = v[2];
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length == 0) return {0, -1, 0}; // of a point light, which has none
    return {float(x / length), float(y / length), float(z / length)};
}

scene::Light to_light(const rt_light_desc& desc) {
    check(desc);
    scene::Light light;
    light.type = scene::LightType(desc.type);
    light.position = {desc.position[0], desc.position[1], desc.position[2]};
    light.direction = unit(desc.direction);
    light.radius = desc.radius;
    light.falloff = scene::Falloff(desc.falloff);
    light.intensity = {desc.intensity[0], desc.intensity[1], desc.intensity[2]};
    light.cone_inner_cos = desc.cone_inner_cos;
    light.cone_outer_cos = desc.cone_outer_cos;
    light.casts_shadow = desc.casts_no_shadow == 0;
    light.source_radius = desc.source_radius;
    light.fog_scatter = desc.fog_scatter;
    if (desc.shadow_samples > 0) light.shadow_samples = desc.shadow_samples;
    return light;
}

static_assert(RT_SKY_TEXTURE == int(scene::SkyKind::texture));

math::Vec3 to_color(const float (&color)[3]) {
    return {color[0], color[1], color[2]};
}

scene::Sky to_sky(const rt_environment& fields) {
    require_enum(fields.sky, RT_SKY_TEXTURE, "rt_environment.sky");
    require_colour(fields.zenith, "rt_environment.zenith");
    require_colour(fields.horizon, "rt_environment.horizon");
    require_colour(fields.ground, "rt_environment.ground");
    require_least_zero(fields.sky_intensity, "rt_environment.sky_intensity");
    require_finite(fields.sky_rotation, "rt_environment.sky_rotation");
    scene::Sky sky;
    sky.kind = scene::SkyKind(fields.sky);
    sky.zenith = to_color(fields.zenith);
    sky.horizon = to_color(fields.horizon);
    sky.ground = to_color(fields.ground);
    sky.intensity = fields.sky_intensity;
    sky.cosine = float(std::cos(double(fields.sky_rotation)));
    sky.sine = float(std::sin(double(fields.sky_rotation)));
    return sky;
}

scene::Environment to_environment(const rt_environment& fields) {
    require_colour(fields.ambient, "rt_environment.ambient");
    require_colour(fields.background, "rt_environment.background");
    require_zero(fields.reserved, "rt_environment.reserved");
    return {to_color(fields.ambient), to_color(fields.background), to_sky(fields)};
}

void set_environment(scene::Scene& scene, const rt_environment& fields) {
    const scene::Environment environment = to_environment(fields);
    const base::Handle texture = to_handle(fields.sky_texture);
    if (environment.sky.kind == scene::SkyKind::texture)
        require_object(scene.textures, texture, "rt_environment.sky_texture", "texture");
    scene.environment = environment;
    scene.sky_texture = texture;
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_add_light(rt_scene scene, const rt_light_desc* desc, rt_light* out_light) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_light, "out_light");
        *out_light = to_host<rt_light>(host.scene.lights.insert(to_light(read_struct(desc))));
    });
}

rt_result rt_update_light(rt_scene scene, rt_light light, const rt_light_desc* desc) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        auto& old = require_object(host.scene.lights, to_handle(light), "rt_light", "light");
        old = to_light(read_struct(desc));
    });
}

rt_result rt_remove_light(rt_scene scene, rt_light light) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_object(host.scene.lights, to_handle(light), "rt_light", "light");
        host.scene.lights.erase(to_handle(light));
    });
}

rt_result rt_set_environment(rt_scene scene, const rt_environment* environment) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        set_environment(host.scene, read_struct(environment));
    });
}
