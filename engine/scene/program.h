#pragma once

#include "base/slot_map.h"

#include <cstdint>

namespace peregrine::scene {

// Hits for a shading program, a place in each array for one; see rt_program_batch. What the program
// does not ask for is null.
struct ProgramBatch {
    uint32_t count = 0;
    uint32_t padded_count = 0;
    const float* position[3] = {};
    const float* geometric_normal[3] = {};
    const float* shading_normal[3] = {};
    const float* direction[3] = {};
    const float* distance = nullptr;
    const float* footprint = nullptr;
    const float* texcoord[2] = {};
    const float* barycentric[2] = {};
    const uint32_t* triangle = nullptr;
    const base::Handle* mesh = nullptr;
    const uint32_t* back_face = nullptr;
    const uint64_t* mesh_user_data = nullptr;
    const uint64_t* material_user_data = nullptr;
    const float* base_color[3] = {};
    const float* emissive[3] = {};
    const float* diffuse[3] = {};
    const float* highlight[3] = {};
    const float* openness = nullptr;
    float* radiance[3] = {};
    float* ray_direction[3] = {};
    float* ray_weight[3] = {};
};

// A shading program of the host. The values of fields are those of RT_PROGRAM_*.
struct HostProgram {
    enum Field : uint32_t {
        kPosition = 1u << 0,
        kGeometricNormal = 1u << 1,
        kShadingNormal = 1u << 2,
        kDirection = 1u << 3,
        kDistance = 1u << 4,
        kFootprint = 1u << 5,
        kTexcoord = 1u << 6,
        kBarycentrics = 1u << 7,
        kIds = 1u << 8,
        kBackFace = 1u << 9,
        kUserData = 1u << 10,
        kBaseColor = 1u << 11,
        kEmissiveColor = 1u << 12,
        kDiffuse = 1u << 13,
        kHighlight = 1u << 14,
        kOpenness = 1u << 15,
        kRays = 1u << 16,
        kAllFields = (1u << 17) - 1,
    };

    uint32_t fields = 0;
    void (*call)(const HostProgram& program, const ProgramBatch& batch) = nullptr;
    void (*function)() = nullptr; // of the host, with ...
    void* user = nullptr;         // ... this, for `call`

    bool wants(Field field) const { return (fields & field) != 0; }
    bool wants_light() const { return (fields & (kDiffuse | kHighlight)) != 0; }
};

} // namespace peregrine::scene
