/* Prints the layout of every struct of the header: "struct NAME SIZE", then "NAME.FIELD OFFSET
 * SIZE". tests/golden/abi_layout.txt is this output. After an addition to the header, regenerate it
 * with build/release/bin/abi.layout > tests/golden/abi_layout.txt and read the difference: lines
 * may be added, struct sizes may grow, nothing else may change. */
#include "abi_layout.h"

static void print_handles(void) {
    STRUCT(rt_scene);
    FIELD(rt_scene, index);
    FIELD(rt_scene, generation);
    STRUCT(rt_mesh);
    FIELD(rt_mesh, index);
    FIELD(rt_mesh, generation);
    STRUCT(rt_material);
    FIELD(rt_material, index);
    FIELD(rt_material, generation);
    STRUCT(rt_texture);
    FIELD(rt_texture, index);
    FIELD(rt_texture, generation);
    STRUCT(rt_light);
    FIELD(rt_light, index);
    FIELD(rt_light, generation);
    STRUCT(rt_program);
    FIELD(rt_program, index);
    FIELD(rt_program, generation);
    STRUCT(rt_snapshot);
    FIELD(rt_snapshot, index);
    FIELD(rt_snapshot, generation);
}

static void print_host(void) {
    STRUCT(rt_allocator);
    FIELD(rt_allocator, user);
    FIELD(rt_allocator, allocate);
    FIELD(rt_allocator, deallocate);
    STRUCT(rt_scheduler);
    FIELD(rt_scheduler, user);
    FIELD(rt_scheduler, run);
    FIELD(rt_scheduler, concurrency);
    FIELD(rt_scheduler, reserved);
    STRUCT(rt_scene_desc);
    FIELD(rt_scene_desc, struct_size);
    FIELD(rt_scene_desc, worker_count);
    FIELD(rt_scene_desc, allocator);
    FIELD(rt_scene_desc, scheduler);
    FIELD(rt_scene_desc, log);
    FIELD(rt_scene_desc, log_user);
    FIELD(rt_scene_desc, isa);
    FIELD(rt_scene_desc, reserved);
}

static void print_table(void) {
    STRUCT(rt_api);
    FIELD(rt_api, struct_size);
    FIELD(rt_api, version);
    FIELD(rt_api, get_last_error);
    FIELD(rt_api, get_result_name);
    FIELD(rt_api, get_version_string);
    FIELD(rt_api, create_scene);
    FIELD(rt_api, destroy_scene);
    FIELD(rt_api, add_texture);
    FIELD(rt_api, remove_texture);
    FIELD(rt_api, add_material);
    FIELD(rt_api, update_material);
    FIELD(rt_api, remove_material);
    FIELD(rt_api, add_static_mesh);
    FIELD(rt_api, add_dynamic_mesh);
    FIELD(rt_api, update_dynamic_mesh);
    FIELD(rt_api, remove_mesh);
    FIELD(rt_api, add_light);
    FIELD(rt_api, update_light);
    FIELD(rt_api, remove_light);
    FIELD(rt_api, set_environment);
    FIELD(rt_api, commit_scene);
    FIELD(rt_api, trace_query);
    FIELD(rt_api, resolve_hits);
    FIELD(rt_api, render_frame);
    FIELD(rt_api, get_scene_stats);
    FIELD(rt_api, add_rigid_mesh);
    FIELD(rt_api, add_mesh_instance);
    FIELD(rt_api, set_mesh_transform);
    FIELD(rt_api, set_mesh_layer_mask);
    FIELD(rt_api, set_mesh_hidden);
    FIELD(rt_api, set_world_origin);
    FIELD(rt_api, hold_snapshot);
    FIELD(rt_api, release_snapshot);
    FIELD(rt_api, sweep_shapes);
    FIELD(rt_api, overlap_shapes);
    FIELD(rt_api, find_nearest);
    FIELD(rt_api, set_mesh_user_data);
    FIELD(rt_api, resolve_surfaces);
    FIELD(rt_api, govern_frame);
    FIELD(rt_api, set_fog);
    FIELD(rt_api, add_program);
    FIELD(rt_api, remove_program);
    FIELD(rt_api, adapt_exposure);
    FIELD(rt_api, bake_light);
}

int main(void) {
    print_handles();
    print_host();
    print_programs();
    print_looks();
    print_shapes();
    print_lights();
    print_commit();
    print_query();
    print_sweeps();
    print_frame();
    print_table();
    return 0;
}
