#pragma once

#include <algorithm>
#include <cstdint>

namespace peregrine::shade {

// Which solids a ray is in, by their materials: it enters one by a front face and leaves it by a
// back face. Where several overlap, that which was entered last is what the ray sees of them.
struct Media {
    static constexpr uint32_t kMost = 4; // of more the outermost are forgotten
    static constexpr uint32_t kNone = 0; // the default material, which is no solid

    uint32_t material[kMost] = {}; // the innermost first

    uint32_t innermost() const { return material[0]; }
    bool any() const { return innermost() != kNone; }

    bool holds(uint32_t solid) const {
        return std::find(material, material + kMost, solid) != material + kMost;
    }
    void enter(uint32_t solid) {
        std::copy_backward(material, material + kMost - 1, material + kMost);
        material[0] = solid;
    }
    void leave(uint32_t solid) {
        uint32_t* const found = std::find(material, material + kMost, solid);
        if (found == material + kMost) return;
        std::copy(found + 1, material + kMost, found);
        material[kMost - 1] = kNone;
    }
};

} // namespace peregrine::shade
