#pragma once

#include "base/memory.h"

#include <cstdint>

namespace peregrine::shade {

// A light that a place can hardly see.
struct DimLight {
    float most; // lux that it gives there
    uint32_t number;
};

// One thread's working memory for the choice of lights; each array has room for all of them.
struct LightLists {
    uint32_t* found = nullptr;  // by their numbers: by the tree, ...
    uint32_t* chosen = nullptr; // ... and of all
    DimLight* dim = nullptr;    // null unless some are left out
};

// The memory of all threads of a frame.
class LightRoom {
public:
    LightRoom(size_t lights, bool leaves_out, uint32_t threads, base::Memory* memory)
        : lights_(lights), numbers_(2 * lights * threads, memory),
          dim_(leaves_out ? lights * threads : 0, memory) {}

    LightLists lists(uint32_t thread) {
        const size_t first = lights_ * thread;
        uint32_t* const found = numbers_.data() + 2 * first;
        return {found, found + lights_, dim_.empty() ? nullptr : dim_.data() + first};
    }

private:
    size_t lights_;
    base::Vector<uint32_t> numbers_;
    base::Vector<DimLight> dim_;
};

} // namespace peregrine::shade
