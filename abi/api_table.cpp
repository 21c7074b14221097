#include "peregrine/rt.h"

#ifndef PEREGRINE_VERSION
#define PEREGRINE_VERSION "0.1.0"
#endif

namespace {

constexpr rt_api kApi = {
    .struct_size = sizeof(rt_api),
    .version = RT_API_VERSION,
    .get_last_error = rt_get_last_error,
    .get_result_name = rt_get_result_name,
    .get_version_string = rt_get_version_string,
    .create_scene = rt_create_scene,
    .destroy_scene = rt_destroy_scene,
    .add_texture = rt_add_texture,
    .remove_texture = rt_remove_texture,
    .add_material = rt_add_material,
    .update_material = rt_update_material,
    .remove_material = rt_remove_material,
    .add_static_mesh = rt_add_static_mesh,
    .add_dynamic_mesh = rt_add_dynamic_mesh,
    .update_dynamic_mesh = rt_update_dynamic_mesh,
    .remove_mesh = rt_remove_mesh,
    .add_light = rt_add_light,
    .update_light = rt_update_light,
    .remove_light = rt_remove_light,
    .set_environment = rt_set_environment,
    .commit_scene = rt_commit_scene,
    .trace_query = rt_trace_query,
    .resolve_hits = rt_resolve_hits,
    .render_frame = rt_render_frame,
    .get_scene_stats = rt_get_scene_stats,
    .add_rigid_mesh = rt_add_rigid_mesh,
    .add_mesh_instance = rt_add_mesh_instance,
    .set_mesh_transform = rt_set_mesh_transform,
    .set_mesh_layer_mask = rt_set_mesh_layer_mask,
    .set_mesh_hidden = rt_set_mesh_hidden,
    .set_world_origin = rt_set_world_origin,
    .hold_snapshot = rt_hold_snapshot,
    .release_snapshot = rt_release_snapshot,
    .sweep_shapes = rt_sweep_shapes,
    .overlap_shapes = rt_overlap_shapes,
    .find_nearest = rt_find_nearest,
    .set_mesh_user_data = rt_set_mesh_user_data,
    .resolve_surfaces = rt_resolve_surfaces,
    .govern_frame = rt_govern_frame,
    .set_fog = rt_set_fog,
    .add_program = rt_add_program,
    .remove_program = rt_remove_program,
    .adapt_exposure = rt_adapt_exposure,
    .bake_light = rt_bake_light,
};

constexpr const char* kResultNames[] = {
    "RT_OK",
    "RT_ERROR_INVALID_ARGUMENT",
    "RT_ERROR_INVALID_HANDLE",
    "RT_ERROR_INVALID_STRUCT",
    "RT_ERROR_LIMIT",
    "RT_ERROR_OUT_OF_MEMORY",
    "RT_ERROR_CANCELLED",
    "RT_ERROR_NOT_COMMITTED",
    "RT_ERROR_UNSUPPORTED",
    "RT_ERROR_INTERNAL",
};
static_assert(sizeof kResultNames / sizeof kResultNames[0] == RT_ERROR_INTERNAL + 1);

} // namespace

const rt_api* rt_get_api(uint32_t version) noexcept {
    return version == RT_API_VERSION ? &kApi : nullptr;
}

const char* rt_get_result_name(rt_result result) noexcept {
    return result >= RT_OK && result <= RT_ERROR_INTERNAL ? kResultNames[result]
                                                          : "unknown rt_result";
}

const char* rt_get_version_string() noexcept {
    return PEREGRINE_VERSION;
}
