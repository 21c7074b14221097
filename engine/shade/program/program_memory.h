#pragma once

#include "base/slot_map.h"
#include "shade/surface/surface.h"

#include <cstddef>
#include <cstdint>

namespace peregrine::shade {

// One thread's working memory for the host's shading programs.
struct alignas(64) ProgramMemory {
    using Lanes = Surface::Lanes;
    // Neighbouring rays that one program shades.
    struct Span {
        uint32_t begin, end;
    };

    uint32_t program[kBatch]; // of each run of the surface: in MaterialSet::programs; 0: none

    // The hits of one program: where they are in the batch, run by run and in one, ...
    uint32_t runs[kBatch]; // of the surface
    uint32_t run_count;
    Span spans[kBatch];
    uint32_t span_count;
    uint32_t count;

    // ... what it gets, see rt_program_batch, ...
    alignas(64) Lanes position[3];
    Lanes geometric_normal[3];
    Lanes shading_normal[3];
    Lanes direction[3];
    Lanes distance;
    Lanes footprint;
    Lanes texcoord[2];
    Lanes barycentric[2];
    uint32_t triangle[kPadded];
    base::Handle mesh[kPadded];
    uint32_t back_face[kPadded];
    uint64_t mesh_user_data[kPadded];
    uint64_t material_user_data[kPadded];
    Lanes base_color[3];
    Lanes emissive[3];
    Lanes diffuse[3];
    Lanes highlight[3];
    Lanes specular; // on the way there: a channel of it
    Lanes openness;
    Lanes bounced;

    // ... and what it says.
    Lanes radiance[3];
    Lanes ray_direction[3];
    Lanes ray_weight[3];
    uint32_t sane[kPadded];     // 0 where it says what can't be: at all, ...
    uint32_t sane_ray[kPadded]; // ... of a ray

    // Normals of surfaces that no lamp needs to light, while lamps are asked.
    Lanes unlit_geometric[3];
    Lanes unlit_normal[3];

    uint64_t hit_count;   // of a frame: that programs shaded, and ...
    uint64_t fault_count; // ... of which they said what can't be
};
// All that a program gets is aligned, since `position` is.
static_assert(sizeof(Surface::Lanes) % 64 == 0 && sizeof(base::Handle[kPadded]) % 64 == 0);
static_assert(offsetof(ProgramMemory, ray_weight) % 64 == 0);

} // namespace peregrine::shade
