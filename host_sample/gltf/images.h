#pragma once

#include <cstdint>
#include <map>

#include <tiny_gltf.h>

#include "../level.h"
#include "notes.h"

namespace host::gltf {

// Decodes images when a material first needs them. One that cannot be read becomes a magenta
// chequerboard and a note: a scene without a picture is better than none.
class Images {
  public:
    Images(const tinygltf::Model& model, Level& level, Notes& notes)
        : m_model(model), m_level(level), m_notes(notes) {}

    // The number of the image in the level; `source` is any number that the file holds.
    uint32_t open(int source);

  private:
    const tinygltf::Model& m_model;
    Level& m_level;
    Notes& m_notes;
    std::map<int, uint32_t> m_open;
    uint64_t m_bytes = 0;
};

} // namespace host::gltf
