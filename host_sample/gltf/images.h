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
        : model_(model), level_(level), notes_(notes) {}

    // The number of the image in the level; `source` is any number that the file holds.
    uint32_t open(int source);

private:
    const tinygltf::Model& model_;
    Level& level_;
    Notes& notes_;
    std::map<int, uint32_t> open_;
    uint64_t bytes_ = 0;
};

} // namespace host::gltf
