#pragma once

#include <cstdint>

namespace host {

// How much a picture shows beside surfaces, their mirrors and lamps.
enum class Effects : uint32_t {
    plain, // nothing
    full,  // glow, and what the level's names ask for: see LevelEffects
    rich   // and how open places are to ambient light, which takes time
};

} // namespace host
