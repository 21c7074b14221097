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
    bool double_sided = false;
    TextureUse base_color_texture;
    TextureUse normal_texture;
    TextureUse emissive_texture;
    uint32_t slot = 0; // of the handle, with its generation; 0, 0: the default material
    uint32_t generation = 0;
    uint64_t user_data = 0;
};

} // namespace peregrine::scene
