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
        : m_left(std::min<uint64_t>(uint64_t{1} << 27, 1'000'000 + 4 * bytes_read)) {}

    // Takes `items` triangles or vertices, and a little for the visit itself.
    void spend(uint64_t items) {
        const uint64_t cost = items + 8;
        if (items > m_left || cost > m_left)
            throw InputError("the scene asks for more triangles than a file of its size may");
        m_left -= cost;
    }

  private:
    uint64_t m_left;
};

} // namespace host::gltf
