#pragma once

#include <cstdint>
#include <map>

#include "../level.h"
#include "document.h"
#include "notes.h"

namespace host::gltf {

// Decodes images when a material first needs them. One that cannot be read becomes a magenta
// chequerboard and a note: a scene without a picture is better than none.
class Images {
public:
    Images(const Document& document, Level& level, Notes& notes)
        : document_(document), level_(level), notes_(notes) {}

    // The number of the image in the level; `source` is any number that the file holds.
    uint32_t open(int source);

    // The chequerboard, for what has no image, and why.
    uint32_t replace(const std::string& name, const std::string& cause);

private:
    ImageSource find(int source) const;
    uint32_t add(Image image);

    const Document& document_;
    Level& level_;
    Notes& notes_;
    std::map<int, uint32_t> open_;
    std::map<std::string, uint32_t> replaced_;
    uint64_t bytes_ = 0;
};

} // namespace host::gltf
