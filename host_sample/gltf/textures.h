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
        : m_model(model), m_level(level), m_notes(notes), m_images(model, level, notes) {}

    TextureUse use(int texture, int texcoord_set, const tinygltf::ExtensionMap& extensions,
                   bool srgb);

  private:
    uint32_t find_or_add(const Texture& texture);

    const tinygltf::Model& m_model;
    Level& m_level;
    Notes& m_notes;
    Images m_images;
    std::map<Texture, uint32_t> m_known;
};

} // namespace host::gltf
