#pragma once

#include <map>

#include <tiny_gltf.h>

#include "../level.h"
#include "images.h"
#include "notes.h"

namespace host::gltf {

// Turns a material's references to textures into TextureUse: image, sampler, colour space, UV
// set and KHR_texture_transform.
class Textures {
public:
    Textures(const tinygltf::Model& model, Level& level, Notes& notes)
        : model_(model), level_(level), notes_(notes), images_(model, level, notes) {}

    TextureUse use(int texture, int texcoord_set, const tinygltf::ExtensionMap& extensions,
                   bool srgb);

private:
    uint32_t find_or_add(const Texture& texture);

    const tinygltf::Model& model_;
    Level& level_;
    Notes& notes_;
    Images images_;
    std::map<Texture, uint32_t> known_;
};

} // namespace host::gltf
