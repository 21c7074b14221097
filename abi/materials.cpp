#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene/collect.h"
#include "scene_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace peregrine::abi {
namespace {

// "rt_material_desc.normal_texture" + ".reserved", in a buffer of the caller.
class FieldName {
public:
    FieldName(const char* use, const char* member) {
        std::snprintf(text_, sizeof text_, "rt_material_desc.%s.%s", use, member);
    }
    operator const char*() const { return text_; }

private:
    char text_[96];
};

scene::TextureUse to_use(const rt_texture_use& use, const char* name) {
    require_finite(std::span<const float>(use.transform), FieldName(name, "transform"));
    if (use.texcoord_set > 1)
        base::fail(base::Code::invalid_argument, "%s is %u; it must be 0 or 1",
                   static_cast<const char*>(FieldName(name, "texcoord_set")), use.texcoord_set);
    require_zero(use.reserved, FieldName(name, "reserved"));
    scene::TextureUse result;
    result.row_u = {use.transform[0], use.transform[1], use.transform[2]};
    result.row_v = {use.transform[3], use.transform[4], use.transform[5]};
    result.texcoord_set = use.texcoord_set;
    return result;
}

base::Handle to_texture(scene::Scene& scene, const rt_texture_use& use, const char* name) {
    const base::Handle texture = to_handle(use.texture);
    if (texture || texture.index != 0)
        require_object(scene.textures, texture, FieldName(name, "texture"), "texture");
    return texture;
}

void check_numbers(const rt_material_desc& desc) {
    require_enum(desc.alpha_mode, RT_ALPHA_BLEND, "rt_material_desc.alpha_mode");
    require_colour(desc.base_color, "rt_material_desc.base_color");
    require_colour(desc.emissive, "rt_material_desc.emissive");
    require_finite(desc.alpha_cutoff, "rt_material_desc.alpha_cutoff");
    require_colour(desc.specular, "rt_material_desc.specular");
    require_finite(desc.shininess, "rt_material_desc.shininess");
    if (desc.shininess < 1)
        base::fail(base::Code::invalid_argument,
                   "rt_material_desc.shininess is %g; it must be at least 1",
                   double(desc.shininess));
    require_finite(desc.normal_scale, "rt_material_desc.normal_scale");
    require_flag(desc.double_sided, "rt_material_desc.double_sided");
}

void require_share(float value, const char* field) {
    if (!(value >= 0 && value <= 1))
        base::fail(base::Code::invalid_argument, "%s is %g; it must be 0 to 1", field,
                   double(value));
}

void require_shares(const float (&values)[3], const char* field) {
    require_colour(values, field);
    for (const float value : values) require_share(value, field);
}

void check_paths(const rt_material_desc& desc) {
    constexpr float kLargestIndex = 10;
    require_share(desc.reflectivity, "rt_material_desc.reflectivity");
    require_shares(desc.reflection_color, "rt_material_desc.reflection_color");
    require_share(desc.transmission, "rt_material_desc.transmission");
    const float index = desc.index_of_refraction;
    if (index != 0 && !(index >= 1 && index <= kLargestIndex))
        base::fail(base::Code::invalid_argument,
                   "rt_material_desc.index_of_refraction is %g; it must be 0 or from 1 to %g",
                   double(index), double(kLargestIndex));
    require_shares(desc.attenuation_color, "rt_material_desc.attenuation_color");
    require_least_zero(desc.attenuation_distance, "rt_material_desc.attenuation_distance");
    require_flag(desc.thin, "rt_material_desc.thin");
    require_zero(desc.reserved, "rt_material_desc.reserved");
}

// Per metre (Beer's law). What is black lets 1e-6 through.
math::Vec3 absorption(const rt_material_desc& desc) {
    math::Vec3 result(0);
    if (desc.attenuation_distance == 0) return result;
    for (int k = 0; k < 3; ++k) {
        const double left = std::max(double(desc.attenuation_color[k]), 1e-6);
        result[k] = float(std::min(-std::log(left) / double(desc.attenuation_distance), 1e30));
    }
    return result;
}

void describe_paths(const rt_material_desc& desc, scene::Material& material) {
    constexpr float kUsualIndex = 1.5f;
    check_paths(desc);
    material.reflectivity = desc.reflectivity;
    material.reflection_color = {desc.reflection_color[0], desc.reflection_color[1],
                                 desc.reflection_color[2]};
    material.transmission = desc.transmission;
    material.index_of_refraction =
        desc.index_of_refraction == 0 ? kUsualIndex : desc.index_of_refraction;
    material.absorption = absorption(desc);
    material.thin = desc.thin != 0;
}

// Mirrors and glass are the program's own.
base::Handle to_program(scene::Scene& scene, const rt_material_desc& desc) {
    const base::Handle program = to_handle(desc.program);
    if (!program && program.index == 0) return program;
    require_object(scene.programs, program, "rt_material_desc.program", "program");
    for (const auto& [value, name] : {std::pair{desc.reflectivity, "reflectivity"},
                                      std::pair{desc.transmission, "transmission"}})
        if (value != 0)
            base::fail(base::Code::invalid_argument,
                       "rt_material_desc.%s is %g; it must be 0 with a program, which asks for "
                       "rays itself",
                       name, double(value));
    return program;
}

void describe_wear(const rt_material_desc& desc, scene::Material& material) {
    require_share(desc.occlusion_strength, "rt_material_desc.occlusion_strength");
    require_share(desc.roughness, "rt_material_desc.roughness");
    require_share(desc.metalness, "rt_material_desc.metalness");
    require_zero(desc.reserved2, "rt_material_desc.reserved2");
    material.occlusion_texture = to_use(desc.occlusion_texture, "occlusion_texture");
    material.roughness_texture = to_use(desc.roughness_texture, "roughness_texture");
    material.occlusion_strength = desc.occlusion_strength;
    material.roughness = desc.roughness;
    material.metalness = desc.metalness;
}

scene::MaterialDescription describe(scene::Scene& scene, const rt_material_desc& desc) {
    check_numbers(desc);
    scene::MaterialDescription result;
    scene::Material& material = result.material;
    material.base_color = {desc.base_color[0], desc.base_color[1], desc.base_color[2],
                           desc.base_color[3]};
    material.emissive = {desc.emissive[0], desc.emissive[1], desc.emissive[2]};
    material.alpha_cutoff = desc.alpha_cutoff;
    material.specular = {desc.specular[0], desc.specular[1], desc.specular[2]};
    material.shininess = desc.shininess;
    material.normal_scale = desc.normal_scale;
    material.masked = desc.alpha_mode == RT_ALPHA_MASK;
    material.blended = desc.alpha_mode == RT_ALPHA_BLEND;
    material.double_sided = desc.double_sided != 0;
    describe_paths(desc, material);
    describe_wear(desc, material);
    material.base_color_texture = to_use(desc.base_color_texture, "base_color_texture");
    material.normal_texture = to_use(desc.normal_texture, "normal_texture");
    material.emissive_texture = to_use(desc.emissive_texture, "emissive_texture");
    material.user_data = desc.user_data;
    result.base_color_texture = to_texture(scene, desc.base_color_texture, "base_color_texture");
    result.normal_texture = to_texture(scene, desc.normal_texture, "normal_texture");
    result.emissive_texture = to_texture(scene, desc.emissive_texture, "emissive_texture");
    result.occlusion_texture = to_texture(scene, desc.occlusion_texture, "occlusion_texture");
    result.roughness_texture = to_texture(scene, desc.roughness_texture, "roughness_texture");
    result.program = to_program(scene, desc);
    return result;
}

void update(scene::Scene& scene, rt_material handle, const rt_material_desc& desc) {
    auto& old = require_object(scene.materials, to_handle(handle), "rt_material", "material");
    const scene::MaterialDescription now = describe(scene, desc);
    if (scene::flags_of(old.material) != scene::flags_of(now.material)) scene.touch_flags();
    old = now;
    scene.touch_materials();
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_add_material(rt_scene scene, const rt_material_desc* desc,
                          rt_material* out_material) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_material, "out_material");
        *out_material = to_host<rt_material>(
            host.scene.materials.insert(describe(host.scene, read_struct(desc))));
        host.scene.touch_materials();
    });
}

rt_result rt_update_material(rt_scene scene, rt_material material,
                             const rt_material_desc* desc) noexcept {
    return guard([&] { update(find_scene(scene).scene, material, read_struct(desc)); });
}

rt_result rt_remove_material(rt_scene scene, rt_material material) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_object(host.scene.materials, to_handle(material), "rt_material", "material");
        host.scene.materials.erase(to_handle(material));
        host.scene.touch_materials();
        host.scene.touch_flags(); // its meshes show the default one from now on
    });
}
