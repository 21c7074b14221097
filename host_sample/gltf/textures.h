#pragma once

#include <map>

#include "../level.h"
#include "../texture_mean.h"
#include "document.h"
#include "images.h"
#include "notes.h"

namespace host::gltf {

// Turns a material's references to textures into TextureUse: image, sampler, colour space, UV
// set and KHR_texture_transform.
class Textures {
public:
    Textures(const Document& document, Level& level, Notes& notes)
        : model_(document.model), level_(level), notes_(notes), images_(document, level, notes) {}

    TextureUse use(int texture, int texcoord_set, const tinygltf::ExtensionMap& extensions,
                   bool srgb);
    glm::vec3 mean(const TextureUse& use) const { return glm::vec3(mean_of(level_, use)); }

private:
    uint32_t open_image(int texture);
    uint32_t find_or_add(const Texture& texture);

    const tinygltf::Model& model_;
    Level& level_;
    Notes& notes_;
    Images images_;
    std::map<Texture, uint32_t> known_;
};

} // namespace host::gltf
