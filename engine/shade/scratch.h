#pragma once

#include "shade/air/airlight.h"
#include "shade/light/illumination.h"
#include "shade/light/light_lists.h"
#include "shade/light/shadow_memory.h"
#include "shade/light/tint_memory.h"
#include "shade/occlusion/openness.h"
#include "shade/program/program_memory.h"
#include "shade/surface/surface.h"

namespace peregrine::shade {

// Working memory for one thread.
struct alignas(64) Scratch {
    Surface surface;
    Illumination light;
    LightWeights weights;
    ShadowMemory shadow;
    LightLists lists;
    OpennessMemory* openness = nullptr; // if the shader finds it
    ProgramMemory* programs = nullptr;  // if the shader has any
    AirlightMemory* airlight = nullptr; // of frames that have any
    TintMemory* tints = nullptr;        // of those in which light is tinted
};

} // namespace peregrine::shade
