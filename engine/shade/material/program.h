#pragma once

#include "scene/features.h"

#include <array>
#include <cstdint>

namespace peregrine::shade {

// How surfaces reflect light: one file each (matt-inl.h, highlight-inl.h), in the order of the list
// in shade/kernels.cpp. A program can do all that those before it can.
enum class Program : uint32_t { matt = 0, highlight = 1 };
inline constexpr uint32_t kProgramCount = 2;

template <class Kernel>
using ByProgram = std::array<Kernel, kProgramCount>;

// The first program that serves all materials with these features.
inline Program program_for(uint32_t features) {
    return features & scene::kSpecular ? Program::highlight : Program::matt;
}

} // namespace peregrine::shade
