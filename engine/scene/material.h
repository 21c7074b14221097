#pragma once

#include "math/vec.h"

#include <cstdint>

namespace peregrine::scene {

struct Texture;

// A texture with the transform of its coordinates: (u', v') = rows . (u, v, 1).
struct TextureUse {
    const Texture* texture = nullptr; // kept alive by the snapshot; null: none
    math::Vec3 row_u{1, 0, 0};
    math::Vec3 row_v{0, 1, 0};
    uint32_t texcoord_set = 0;
};

struct Material {
    math::Vec4 base_color{1};
    math::Vec3 emissive{0};
    float alpha_cutoff = 0.5f;
    math::Vec3 specular{0};
    float shininess = 32;
    float normal_scale = 1;
    bool masked = false;
    bool blended = false;
    bool double_sided = false;
    bool thin = false; // see rt_material_desc
    TextureUse base_color_texture;
    TextureUse normal_texture;
    TextureUse emissive_texture;
    TextureUse occlusion_texture; // R: how much of the ambient light arrives
    TextureUse roughness_texture; // G, and B: metalness (shade/material/roughness.h)
    float occlusion_strength = 0; // these three: of the textures
    float roughness = 0;
    float metalness = 0;
    uint32_t slot = 0; // of the handle, with its generation; 0, 0: the default material
    uint32_t generation = 0;
    uint64_t user_data = 0;
    float reflectivity = 0;         // at normal incidence, ...
    math::Vec3 reflection_color{1}; // ... times this
    float transmission = 0;         // of what is not mirrored
    float index_of_refraction = 1.5f;
    math::Vec3 absorption{0};   // of a solid, per metre
    uint32_t program : 31 = 0;  // of the host, in MaterialSet::programs; 0: none. It ...
    uint32_t asks_rays : 1 = 0; // ... may send rays on

    // Whether it is the hull of something that light goes through, and bends in.
    bool is_solid() const { return transmission > 0 && !thin; }
    bool shows_both_sides() const { return double_sided || is_solid(); }
    // Whether light may pass its surface.
    bool may_pass_light() const { return transmission > 0 || blended; }
    bool sends_paths_on() const { return reflectivity > 0 || may_pass_light(); }
    // Whether alpha is how much it covers.
    bool is_translucent() const { return blended && !is_solid(); }
};

} // namespace peregrine::scene
