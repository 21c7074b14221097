// An engine that only looks like one: it speaks rt.h, counts what it is given and answers rays
// with a floor at y = 0 and a wall at x = 5. Tests of the host need no more.
#include <cmath>
#include <cstring>
#include <limits>

#include <peregrine/rt.h>

namespace {

uint64_t triangles = 0;
uint32_t lights = 0, next_handle = 1;

const char* get_last_error() {
    return "the fake engine was asked to fail";
}
const char* get_result_name(rt_result) {
    return "RT_ERROR_INTERNAL";
}
const char* get_version_string() {
    return "0.0.0";
}

rt_result create_scene(const rt_scene_desc*, rt_scene* out) {
    triangles = 0;
    lights = 0;
    *out = {1, 1};
    return RT_OK;
}
rt_result destroy_scene(rt_scene) {
    return RT_OK;
}

template <class Desc, class Handle>
rt_result add(rt_scene, const Desc*, Handle* out) {
    *out = {next_handle++, 1};
    return RT_OK;
}

rt_result add_mesh(rt_scene scene, const rt_mesh_desc* desc, rt_mesh* out) {
    triangles += desc->indices.count / 3;
    return add(scene, desc, out);
}

rt_result add_light(rt_scene scene, const rt_light_desc* desc, rt_light* out) {
    ++lights;
    return add(scene, desc, out);
}

rt_result set_environment(rt_scene, const rt_environment*) {
    return RT_OK;
}

rt_result commit_scene(rt_scene, const rt_commit_desc* desc, rt_commit_report* report) {
    if (desc->progress && desc->progress(desc->progress_user, 0.5f) != 0) return RT_ERROR_CANCELLED;
    report->triangle_count = triangles;
    report->light_count = lights;
    report->left_out = RT_FEATURE_NORMAL_MAPS | RT_FEATURE_DYNAMIC_MESHES;
    return RT_OK;
}

float distance_along(const rt_query_desc& query, const rt_ray& ray, int axis, double plane) {
    const double origin = query.options ? query.options->origin[axis] : 0.0;
    const float t = static_cast<float>(plane - origin - ray.origin[axis]) / ray.direction[axis];
    return t >= ray.t_min && t <= ray.t_max ? t : std::numeric_limits<float>::infinity();
}

rt_result trace_query(rt_scene, const rt_query_desc* query) {
    for (uint64_t i = 0; i < query->ray_count; ++i) {
        const float floor = distance_along(*query, query->rays[i], 1, 0.0);
        const float wall = distance_along(*query, query->rays[i], 0, 5.0);
        const bool miss = std::isinf(floor) && std::isinf(wall);
        query->hits[i] = {std::fmin(floor, wall), 0.0f, 0.0f, miss ? RT_NO_TRIANGLE : wall < floor,
                          {miss ? 0u : 1u, 1},    0,    0};
    }
    return RT_OK;
}

rt_result resolve_hits(rt_scene, const rt_hit* hits, uint64_t count, uint32_t, rt_surface* surfaces,
                       uint32_t) {
    for (uint64_t i = 0; i < count; ++i) {
        surfaces[i] = {};
        surfaces[i].geometric_normal[hits[i].triangle == 1 ? 0 : 1] = 1.0f;
    }
    return RT_OK;
}

// A picture that changes with the camera.
rt_result render_frame(rt_scene, const rt_camera* camera, const rt_frame_desc* frame,
                       rt_frame_stats* stats) {
    const double shade = 0.5 + 0.5 * std::sin(camera->position[0] + camera->position[2]);
    const size_t pixels = size_t{frame->width} * frame->height;
    if (frame->format == RT_FORMAT_RGBA32F) {
        auto* out = static_cast<float*>(frame->pixels);
        for (size_t i = 0; i < pixels * 4; ++i) out[i] = static_cast<float>(shade);
    } else {
        std::memset(frame->pixels, static_cast<int>(255.0 * shade), pixels * 4);
    }
    stats->rays_primary = pixels;
    stats->frame_ms = 1.0;
    return RT_OK;
}

rt_result adapt_exposure(rt_exposure* exposure, float, float) {
    exposure->exposure = 1;
    return RT_OK;
}

rt_result govern_frame(rt_governor*, rt_frame_desc*, const rt_frame_stats*) {
    return RT_OK;
}

rt_result get_scene_stats(rt_scene, rt_scene_stats* stats) {
    stats->threads = 1;
    stats->isa = RT_ISA_SCALAR;
    return RT_OK;
}

rt_api make_api() {
    rt_api api{};
    api.struct_size = sizeof api;
    api.version = RT_API_VERSION;
    api.get_last_error = get_last_error;
    api.get_result_name = get_result_name;
    api.get_version_string = get_version_string;
    api.create_scene = create_scene;
    api.destroy_scene = destroy_scene;
    api.add_texture = add<rt_texture_desc, rt_texture>;
    api.add_material = add<rt_material_desc, rt_material>;
    api.add_static_mesh = add_mesh;
    api.add_light = add_light;
    api.set_environment = set_environment;
    api.commit_scene = commit_scene;
    api.trace_query = trace_query;
    api.resolve_hits = resolve_hits;
    api.render_frame = render_frame;
    api.get_scene_stats = get_scene_stats;
    api.govern_frame = govern_frame;
    api.adapt_exposure = adapt_exposure;
    return api;
}

} // namespace

extern "C" RT_EXPORT const rt_api* rt_get_api(uint32_t) noexcept {
#if defined(FAKE_ENGINE_SPEAKS_NOTHING)
    return nullptr;
#else
    static const rt_api api = make_api();
    return &api;
#endif
}
