#pragma once

#include "scene/material.h"
#include "scene/texture.h"

#include <cstdint>

namespace peregrine::shade {

// What a batch looks at of a material: the textures that its programs ask for. Those that lie alike
// on a triangle share a place, and so their coordinates.
struct MaterialLook {
    struct Sampled {
        const scene::Texture* texture = nullptr; // null: none
        uint32_t place = 0;
    };

    static constexpr uint32_t kMostPlaces = 5;

    const scene::Material* material = nullptr;
    Sampled color, normal, emissive, occlusion, roughness;
    const scene::TextureUse* places[kMostPlaces]; // that are different
    uint32_t place_count = 0;
    float shininess = -1;     // of the material, if specular; it and ...
    float highlight_gain = 0; // ... highlight_gain() of it are kept from material to material

    // `features`: scene::Feature bits.
    void look_at(const scene::Material& material, uint32_t features);

private:
    void add(const scene::TextureUse& use, bool is_wanted, Sampled& out);
};

} // namespace peregrine::shade
