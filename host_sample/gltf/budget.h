#pragma once

#include <algorithm>
#include <cstdint>

#include "../error.h"

namespace host::gltf {

// A file of a few kilobytes can ask for billions of triangles by naming one mesh from many nodes.
// What an import may produce is therefore bounded by what was read.
class Budget {
public:
    explicit Budget(uint64_t bytes_read)
        : left_(std::min<uint64_t>(uint64_t{1} << 27, 1'000'000 + 4 * bytes_read)) {}

    // Takes `items` triangles, vertices or numbers, and a little for the visit itself.
    void spend(uint64_t items) {
        const uint64_t cost = items + 8;
        if (items > left_ || cost > left_)
            throw InputError(
                "the scene asks for more triangles or keys than a file of its size may");
        left_ -= cost;
    }

private:
    uint64_t left_;
};

} // namespace host::gltf
