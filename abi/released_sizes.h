#pragma once

#include "peregrine/rt.h"

#include <cstddef>
#include <cstdint>
#include <iterator>

namespace peregrine::abi {

// The sizes that each versioned struct had at a release, smallest first, the current one last: a
// contract with every host that was ever compiled. When a struct grows, its new size is appended
// here, and sizes once released stay.
template <class Struct>
struct Released;

#define PEREGRINE_RELEASED(STRUCT, ...)                                                            \
    template <>                                                                                    \
    struct Released<STRUCT> {                                                                      \
        static constexpr const char* name = #STRUCT;                                               \
        static constexpr uint32_t sizes[] = {__VA_ARGS__};                                         \
        static_assert(sizes[std::size(sizes) - 1] == sizeof(STRUCT));                              \
        static_assert(offsetof(STRUCT, struct_size) == 0);                                         \
    }

PEREGRINE_RELEASED(rt_scene_desc, 80);
PEREGRINE_RELEASED(rt_texture_desc, 48);
PEREGRINE_RELEASED(rt_program_desc, 24);
PEREGRINE_RELEASED(rt_material_desc, 192, 240, 248, 344);
PEREGRINE_RELEASED(rt_mesh_desc, 200);
PEREGRINE_RELEASED(rt_mesh_update, 80);
PEREGRINE_RELEASED(rt_light_desc, 72, 80, 88);
PEREGRINE_RELEASED(rt_environment, 32, 88);
PEREGRINE_RELEASED(rt_fog, 40);
PEREGRINE_RELEASED(rt_commit_desc, 32, 40, 56);
PEREGRINE_RELEASED(rt_commit_report, 152, 192, 224);
PEREGRINE_RELEASED(rt_ray_arrays, 72);
PEREGRINE_RELEASED(rt_hit_arrays, 56);
PEREGRINE_RELEASED(rt_query_stats, 32);
PEREGRINE_RELEASED(rt_query_options, 80);
PEREGRINE_RELEASED(rt_query_desc, 88, 128, 136);
PEREGRINE_RELEASED(rt_resolve_desc, 80);
PEREGRINE_RELEASED(rt_sweep_desc, 64);
PEREGRINE_RELEASED(rt_overlap_desc, 80);
PEREGRINE_RELEASED(rt_nearest_desc, 64);
PEREGRINE_RELEASED(rt_camera, 56);
PEREGRINE_RELEASED(rt_frame_desc, 120, 128, 160, 168, 192, 232, 240, 248);
PEREGRINE_RELEASED(rt_frame_stats, 40, 56, 64, 80, 88, 104, 112);
PEREGRINE_RELEASED(rt_governor, 184);
PEREGRINE_RELEASED(rt_exposure, 32);
PEREGRINE_RELEASED(rt_bake_desc, 48);
PEREGRINE_RELEASED(rt_bake_report, 48);
PEREGRINE_RELEASED(rt_scene_stats, 64);

#undef PEREGRINE_RELEASED

} // namespace peregrine::abi
