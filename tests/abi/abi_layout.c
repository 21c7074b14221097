/* Prints the layout of every struct of the header: "struct NAME SIZE", then "NAME.FIELD OFFSET
 * SIZE". tests/golden/abi_layout.txt is this output. After an addition to the header, regenerate it
 * with build/release/bin/abi.layout > tests/golden/abi_layout.txt and read the difference: lines
 * may be added, struct sizes may grow, nothing else may change. */
#include <peregrine/rt.h>

#include <stddef.h>
#include <stdio.h>

#define STRUCT(type) printf("struct %s %zu\n", #type, sizeof(type))
#define FIELD(type, field)                                                                         \
    printf("%s.%s %zu %zu\n", #type, #field, offsetof(type, field), sizeof(((type*)0)->field))

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
    STRUCT(rt_snapshot);
    FIELD(rt_snapshot, index);
    FIELD(rt_snapshot, generation);
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

static void print_looks(void) {
    STRUCT(rt_texture_desc);
    FIELD(rt_texture_desc, struct_size);
    FIELD(rt_texture_desc, format);
    FIELD(rt_texture_desc, pixels);
    FIELD(rt_texture_desc, row_stride);
    FIELD(rt_texture_desc, width);
    FIELD(rt_texture_desc, height);
    FIELD(rt_texture_desc, wrap_u);
    FIELD(rt_texture_desc, wrap_v);
    FIELD(rt_texture_desc, filter);
    FIELD(rt_texture_desc, reserved);
    STRUCT(rt_texture_use);
    FIELD(rt_texture_use, texture);
    FIELD(rt_texture_use, transform);
    FIELD(rt_texture_use, texcoord_set);
    FIELD(rt_texture_use, reserved);
    STRUCT(rt_material_desc);
    FIELD(rt_material_desc, struct_size);
    FIELD(rt_material_desc, alpha_mode);
    FIELD(rt_material_desc, base_color);
    FIELD(rt_material_desc, emissive);
    FIELD(rt_material_desc, alpha_cutoff);
    FIELD(rt_material_desc, specular);
    FIELD(rt_material_desc, shininess);
    FIELD(rt_material_desc, normal_scale);
    FIELD(rt_material_desc, double_sided);
    FIELD(rt_material_desc, base_color_texture);
    FIELD(rt_material_desc, normal_texture);
    FIELD(rt_material_desc, emissive_texture);
    FIELD(rt_material_desc, user_data);
}

static void print_shapes(void) {
    STRUCT(rt_array);
    FIELD(rt_array, data);
    FIELD(rt_array, count);
    FIELD(rt_array, stride);
    FIELD(rt_array, reserved);
    STRUCT(rt_mesh_desc);
    FIELD(rt_mesh_desc, struct_size);
    FIELD(rt_mesh_desc, index_type);
    FIELD(rt_mesh_desc, positions);
    FIELD(rt_mesh_desc, normals);
    FIELD(rt_mesh_desc, tangents);
    FIELD(rt_mesh_desc, texcoords);
    FIELD(rt_mesh_desc, texcoords1);
    FIELD(rt_mesh_desc, indices);
    FIELD(rt_mesh_desc, materials);
    FIELD(rt_mesh_desc, material);
    FIELD(rt_mesh_desc, layer_mask);
    FIELD(rt_mesh_desc, reserved);
    FIELD(rt_mesh_desc, user_data);
    STRUCT(rt_mesh_update);
    FIELD(rt_mesh_update, struct_size);
    FIELD(rt_mesh_update, reserved);
    FIELD(rt_mesh_update, positions);
    FIELD(rt_mesh_update, normals);
    FIELD(rt_mesh_update, tangents);

    STRUCT(rt_transform);
    FIELD(rt_transform, m);
}

static void print_lights(void) {
    STRUCT(rt_light_desc);
    FIELD(rt_light_desc, struct_size);
    FIELD(rt_light_desc, type);
    FIELD(rt_light_desc, position);
    FIELD(rt_light_desc, direction);
    FIELD(rt_light_desc, radius);
    FIELD(rt_light_desc, intensity);
    FIELD(rt_light_desc, cone_inner_cos);
    FIELD(rt_light_desc, cone_outer_cos);
    FIELD(rt_light_desc, casts_no_shadow);
    FIELD(rt_light_desc, falloff);
    FIELD(rt_light_desc, reserved);
    STRUCT(rt_environment);
    FIELD(rt_environment, struct_size);
    FIELD(rt_environment, ambient);
    FIELD(rt_environment, background);
    FIELD(rt_environment, reserved);
}

static void print_commit(void) {
    STRUCT(rt_commit_desc);
    FIELD(rt_commit_desc, struct_size);
    FIELD(rt_commit_desc, empty_bonus);
    FIELD(rt_commit_desc, structure);
    FIELD(rt_commit_desc, quality);
    FIELD(rt_commit_desc, progress);
    FIELD(rt_commit_desc, progress_user);
    FIELD(rt_commit_desc, memory);
    FIELD(rt_commit_desc, reserved);
    STRUCT(rt_commit_report);
    FIELD(rt_commit_report, struct_size);
    FIELD(rt_commit_report, left_out);
    FIELD(rt_commit_report, triangle_count);
    FIELD(rt_commit_report, degenerate_count);
    FIELD(rt_commit_report, non_finite_count);
    FIELD(rt_commit_report, bytes_triangles);
    FIELD(rt_commit_report, bytes_nodes);
    FIELD(rt_commit_report, bytes_references);
    FIELD(rt_commit_report, bytes_attributes);
    FIELD(rt_commit_report, bytes_textures);
    FIELD(rt_commit_report, tree_nodes);
    FIELD(rt_commit_report, tree_leaves);
    FIELD(rt_commit_report, tree_empty_leaves);
    FIELD(rt_commit_report, tree_references);
    FIELD(rt_commit_report, tree_max_depth);
    FIELD(rt_commit_report, tree_depth_limit);
    FIELD(rt_commit_report, tree_sah_cost);
    FIELD(rt_commit_report, build_ms);
    FIELD(rt_commit_report, commit_ms);
    FIELD(rt_commit_report, light_count);
    FIELD(rt_commit_report, rebuilt);
    FIELD(rt_commit_report, structure);
    FIELD(rt_commit_report, quality);
    FIELD(rt_commit_report, dynamic_triangle_count);
    FIELD(rt_commit_report, rigid_triangle_count);
    FIELD(rt_commit_report, instance_count);
    FIELD(rt_commit_report, static_rebuilt);
    FIELD(rt_commit_report, dynamic_rebuilt);
    FIELD(rt_commit_report, reserved);
    FIELD(rt_commit_report, dynamic_build_ms);
}

static void print_query(void) {
    STRUCT(rt_ray);
    FIELD(rt_ray, origin);
    FIELD(rt_ray, t_min);
    FIELD(rt_ray, direction);
    FIELD(rt_ray, t_max);
    STRUCT(rt_hit);
    FIELD(rt_hit, t);
    FIELD(rt_hit, u);
    FIELD(rt_hit, v);
    FIELD(rt_hit, triangle);
    FIELD(rt_hit, mesh);
    FIELD(rt_hit, instance);
    FIELD(rt_hit, back_face);
    STRUCT(rt_ray_arrays);
    FIELD(rt_ray_arrays, struct_size);
    FIELD(rt_ray_arrays, reserved);
    FIELD(rt_ray_arrays, origin);
    FIELD(rt_ray_arrays, direction);
    FIELD(rt_ray_arrays, t_min);
    FIELD(rt_ray_arrays, t_max);
    STRUCT(rt_hit_arrays);
    FIELD(rt_hit_arrays, struct_size);
    FIELD(rt_hit_arrays, reserved);
    FIELD(rt_hit_arrays, t);
    FIELD(rt_hit_arrays, u);
    FIELD(rt_hit_arrays, v);
    FIELD(rt_hit_arrays, triangle);
    FIELD(rt_hit_arrays, mesh);
    FIELD(rt_hit_arrays, back_face);
    STRUCT(rt_query_stats);
    FIELD(rt_query_stats, struct_size);
    FIELD(rt_query_stats, reserved);
    FIELD(rt_query_stats, nodes);
    FIELD(rt_query_stats, triangles);
    FIELD(rt_query_stats, instances);
    STRUCT(rt_query_options);
    FIELD(rt_query_options, struct_size);
    FIELD(rt_query_options, reserved);
    FIELD(rt_query_options, origin);
    FIELD(rt_query_options, snapshot);
    FIELD(rt_query_options, ignore_meshes);
    FIELD(rt_query_options, ignore_count);
    FIELD(rt_query_options, accept);
    FIELD(rt_query_options, accept_user);
    FIELD(rt_query_options, stats);
    STRUCT(rt_query_stats);
    FIELD(rt_query_stats, struct_size);
    FIELD(rt_query_stats, reserved);
    FIELD(rt_query_stats, nodes);
    FIELD(rt_query_stats, triangles);
    FIELD(rt_query_stats, instances);
    STRUCT(rt_query_options);
    FIELD(rt_query_options, struct_size);
    FIELD(rt_query_options, reserved);
    FIELD(rt_query_options, origin);
    FIELD(rt_query_options, snapshot);
    FIELD(rt_query_options, ignore_meshes);
    FIELD(rt_query_options, ignore_count);
    FIELD(rt_query_options, accept);
    FIELD(rt_query_options, accept_user);
    FIELD(rt_query_options, stats);
    STRUCT(rt_query_desc);
    FIELD(rt_query_desc, struct_size);
    FIELD(rt_query_desc, kind);
    FIELD(rt_query_desc, rays);
    FIELD(rt_query_desc, ray_count);
    FIELD(rt_query_desc, ray_stride);
    FIELD(rt_query_desc, result_stride);
    FIELD(rt_query_desc, hits);
    FIELD(rt_query_desc, occluded);
    FIELD(rt_query_desc, faces);
    FIELD(rt_query_desc, layer_mask);
    FIELD(rt_query_desc, ignore_mesh);
    FIELD(rt_query_desc, flags);
    FIELD(rt_query_desc, coherence);
    FIELD(rt_query_desc, ray_arrays);
    FIELD(rt_query_desc, hit_arrays);
    FIELD(rt_query_desc, options);
    FIELD(rt_query_desc, hit_counts);
    FIELD(rt_query_desc, surfaces);
    FIELD(rt_query_desc, surface_stride);
    FIELD(rt_query_desc, surface_fields);
    FIELD(rt_query_desc, max_hits);
    FIELD(rt_query_desc, reserved);
    STRUCT(rt_surface);
    FIELD(rt_surface, position);
    FIELD(rt_surface, geometric_normal);
    FIELD(rt_surface, shading_normal);
    FIELD(rt_surface, texcoord);
    FIELD(rt_surface, material);
    FIELD(rt_surface, material_user_data);
    FIELD(rt_surface, mesh_user_data);
}

static void print_sweeps(void) {
    STRUCT(rt_sweep);
    FIELD(rt_sweep, center);
    FIELD(rt_sweep, radius);
    FIELD(rt_sweep, axis);
    FIELD(rt_sweep, t_max);
    FIELD(rt_sweep, direction);
    FIELD(rt_sweep, reserved);
    STRUCT(rt_sweep_hit);
    FIELD(rt_sweep_hit, t);
    FIELD(rt_sweep_hit, point);
    FIELD(rt_sweep_hit, normal);
    FIELD(rt_sweep_hit, depth);
    FIELD(rt_sweep_hit, triangle);
    FIELD(rt_sweep_hit, mesh);
    FIELD(rt_sweep_hit, initial_contact);
    STRUCT(rt_sweep_desc);
    FIELD(rt_sweep_desc, struct_size);
    FIELD(rt_sweep_desc, flags);
    FIELD(rt_sweep_desc, sweeps);
    FIELD(rt_sweep_desc, sweep_count);
    FIELD(rt_sweep_desc, hits);
    FIELD(rt_sweep_desc, sweep_stride);
    FIELD(rt_sweep_desc, hit_stride);
    FIELD(rt_sweep_desc, faces);
    FIELD(rt_sweep_desc, layer_mask);
    FIELD(rt_sweep_desc, ignore_mesh);
    FIELD(rt_sweep_desc, options);
    STRUCT(rt_shape);
    FIELD(rt_shape, center);
    FIELD(rt_shape, radius);
    FIELD(rt_shape, extent);
    FIELD(rt_shape, kind);
    FIELD(rt_shape, rotation);
    STRUCT(rt_overlap);
    FIELD(rt_overlap, mesh);
    FIELD(rt_overlap, triangle);
    FIELD(rt_overlap, reserved);
    STRUCT(rt_overlap_desc);
    FIELD(rt_overlap_desc, struct_size);
    FIELD(rt_overlap_desc, flags);
    FIELD(rt_overlap_desc, shapes);
    FIELD(rt_overlap_desc, shape_count);
    FIELD(rt_overlap_desc, overlapping);
    FIELD(rt_overlap_desc, overlaps);
    FIELD(rt_overlap_desc, overlap_counts);
    FIELD(rt_overlap_desc, max_overlaps);
    FIELD(rt_overlap_desc, shape_stride);
    FIELD(rt_overlap_desc, faces);
    FIELD(rt_overlap_desc, layer_mask);
    FIELD(rt_overlap_desc, ignore_mesh);
    FIELD(rt_overlap_desc, options);
    STRUCT(rt_point);
    FIELD(rt_point, position);
    FIELD(rt_point, radius);
    STRUCT(rt_nearest);
    FIELD(rt_nearest, distance);
    FIELD(rt_nearest, point);
    FIELD(rt_nearest, normal);
    FIELD(rt_nearest, u);
    FIELD(rt_nearest, v);
    FIELD(rt_nearest, triangle);
    FIELD(rt_nearest, mesh);
    STRUCT(rt_nearest_desc);
    FIELD(rt_nearest_desc, struct_size);
    FIELD(rt_nearest_desc, flags);
    FIELD(rt_nearest_desc, points);
    FIELD(rt_nearest_desc, point_count);
    FIELD(rt_nearest_desc, results);
    FIELD(rt_nearest_desc, point_stride);
    FIELD(rt_nearest_desc, result_stride);
    FIELD(rt_nearest_desc, faces);
    FIELD(rt_nearest_desc, layer_mask);
    FIELD(rt_nearest_desc, ignore_mesh);
    FIELD(rt_nearest_desc, options);
}

static void print_frame(void) {
    STRUCT(rt_camera);
    FIELD(rt_camera, struct_size);
    FIELD(rt_camera, vertical_fov);
    FIELD(rt_camera, position);
    FIELD(rt_camera, forward);
    FIELD(rt_camera, up);
    STRUCT(rt_frame_desc);
    FIELD(rt_frame_desc, struct_size);
    FIELD(rt_frame_desc, format);
    FIELD(rt_frame_desc, pixels);
    FIELD(rt_frame_desc, row_stride);
    FIELD(rt_frame_desc, width);
    FIELD(rt_frame_desc, height);
    FIELD(rt_frame_desc, view);
    FIELD(rt_frame_desc, tone_mapping);
    FIELD(rt_frame_desc, exposure);
    FIELD(rt_frame_desc, depth_range);
    FIELD(rt_frame_desc, steps_range);
    FIELD(rt_frame_desc, no_shadows);
    FIELD(rt_frame_desc, depth);
    FIELD(rt_frame_desc, triangle_ids);
    FIELD(rt_frame_desc, mesh_ids);
    FIELD(rt_frame_desc, normals);
    FIELD(rt_frame_desc, depth_row_stride);
    FIELD(rt_frame_desc, triangle_row_stride);
    FIELD(rt_frame_desc, mesh_row_stride);
    FIELD(rt_frame_desc, normal_row_stride);
    FIELD(rt_frame_desc, snapshot);
    STRUCT(rt_frame_stats);
    FIELD(rt_frame_stats, struct_size);
    FIELD(rt_frame_stats, threads);
    FIELD(rt_frame_stats, rays_primary);
    FIELD(rt_frame_stats, rays_shadow);
    FIELD(rt_frame_stats, frame_ms);
    FIELD(rt_frame_stats, isa);
    FIELD(rt_frame_stats, reserved);
    STRUCT(rt_scene_stats);
    FIELD(rt_scene_stats, struct_size);
    FIELD(rt_scene_stats, threads);
    FIELD(rt_scene_stats, mesh_count);
    FIELD(rt_scene_stats, material_count);
    FIELD(rt_scene_stats, texture_count);
    FIELD(rt_scene_stats, light_count);
    FIELD(rt_scene_stats, snapshot_version);
    FIELD(rt_scene_stats, snapshots_alive);
    FIELD(rt_scene_stats, isa);
    FIELD(rt_scene_stats, bytes_allocated);
    FIELD(rt_scene_stats, bytes_peak);
    FIELD(rt_scene_stats, allocation_count);
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
}

int main(void) {
    print_handles();
    print_host();
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
