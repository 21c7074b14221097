#include "shade/surface/material_look.h"

#include "scene/features.h"
#include "shade/material/highlight.h"

namespace peregrine::shade {
namespace {

bool lie_alike(const scene::TextureUse& a, const scene::TextureUse& b) {
    return a.row_u == b.row_u && a.row_v == b.row_v && a.texcoord_set == b.texcoord_set;
}

} // namespace

void MaterialLook::add(const scene::TextureUse& use, bool is_wanted, Sampled& out) {
    out.texture = is_wanted ? use.texture : nullptr;
    if (!out.texture) return;
    out.place = 0;
    while (out.place < place_count && !lie_alike(*places[out.place], use)) ++out.place;
    if (out.place == place_count) places[place_count++] = &use;
}

void MaterialLook::look_at(const scene::Material& material_, uint32_t features) {
    material = &material_;
    place_count = 0;
    add(material->base_color_texture, features & scene::kTextures, color);
    add(material->normal_texture, features & scene::kNormalMaps, normal);
    add(material->emissive_texture, features & scene::kEmissive, emissive);
    add(material->occlusion_texture, features & scene::kOcclusionTextures, occlusion);
    add(material->roughness_texture, features & scene::kRoughnessTextures, roughness);
    if (!(features & scene::kSpecular) || shininess == material->shininess) return;
    shininess = material->shininess;
    highlight_gain = shade::highlight_gain(shininess);
}

} // namespace peregrine::shade
