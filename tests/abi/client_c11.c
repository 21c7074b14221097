/* A host in C11 that links the library: a floor, a box that falls onto it, a lamp, a frame. */
#include <peregrine/rt.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, #condition,                     \
                    rt_get_last_error());                                                          \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)
#define OK(call) REQUIRE((call) == RT_OK)

static rt_array floats(const float* data, uint64_t count) {
    rt_array array;
    memset(&array, 0, sizeof array);
    array.data = data;
    array.count = count;
    return array;
}

static const uint16_t quad_indices[] = {0, 1, 2, 0, 2, 3};

/* A horizontal square of 2 * half metres at height y that faces up. */
static void fill_quad(float corners[12], float half, float y) {
    const float x[] = {-half, -half, half, half};
    const float z[] = {-half, half, half, -half};
    for (int i = 0; i < 4; ++i) {
        corners[3 * i + 0] = x[i];
        corners[3 * i + 1] = y;
        corners[3 * i + 2] = z[i];
    }
}

static rt_mesh add_quad(rt_scene scene, float half, float y, int moves, rt_material material) {
    float corners[12];
    rt_mesh_desc desc = rt_default_mesh_desc();
    rt_mesh mesh;
    fill_quad(corners, half, y);
    desc.positions = floats(corners, 4);
    desc.index_type = RT_INDEX_UINT16;
    desc.indices.data = quad_indices;
    desc.indices.count = 6;
    desc.material = material;
    desc.user_data = moves ? 22 : 11;
    OK(moves ? rt_add_dynamic_mesh(scene, &desc, &mesh) : rt_add_static_mesh(scene, &desc, &mesh));
    return mesh;
}

static rt_material add_material(rt_scene scene) {
    rt_material_desc desc = rt_default_material_desc();
    rt_material material;
    desc.base_color[1] = 0.5f;
    desc.user_data = 33;
    OK(rt_add_material(scene, &desc, &material));
    return material;
}

static void add_light(rt_scene scene) {
    rt_light_desc desc = rt_default_light_desc();
    rt_light light;
    desc.position[1] = 4.0;
    desc.intensity[0] = desc.intensity[1] = desc.intensity[2] = 20.0f;
    OK(rt_add_light(scene, &desc, &light));
}

static void check_ray_down(rt_scene scene, float from, float expected_t, rt_mesh expected) {
    const rt_ray ray = {{0.25f, from, 0.125f}, 0.0f, {0.0f, -1.0f, 0.0f}, 1000.0f};
    rt_query_desc query = rt_default_query_desc();
    rt_hit hit;
    rt_surface surface;
    uint8_t occluded = 2;
    query.rays = &ray;
    query.ray_count = 1;
    query.hits = &hit;
    OK(rt_trace_query(scene, &query));
    REQUIRE(hit.t == expected_t);
    REQUIRE(hit.mesh.index == expected.index && hit.mesh.generation == expected.generation);
    REQUIRE(hit.back_face == 0);
    query.kind = RT_QUERY_ANY;
    query.occluded = &occluded;
    OK(rt_trace_query(scene, &query));
    REQUIRE(occluded == 1);
    OK(rt_resolve_hits(scene, &hit, 1, 0, &surface, 0));
    REQUIRE(fabs(surface.position[1] - ((double)from - (double)expected_t)) < 1e-6);
    REQUIRE(surface.geometric_normal[1] == 1.0f);
    REQUIRE(surface.material_user_data == 33);
    REQUIRE(surface.mesh_user_data == 11 || surface.mesh_user_data == 22);
}

static void check_frame(rt_scene scene) {
    enum { SIZE = 64 };
    static uint8_t pixels[SIZE * SIZE * 4];
    rt_camera camera = rt_default_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    rt_frame_stats stats = rt_default_frame_stats();
    unsigned bright = 0;
    camera.position[1] = 3.0;
    camera.position[2] = 6.0;
    camera.forward[1] = -0.5f;
    frame.pixels = pixels;
    frame.width = frame.height = SIZE;
    OK(rt_render_frame(scene, &camera, &frame, &stats));
    REQUIRE(stats.rays_primary == SIZE * SIZE);
    for (int i = 0; i < SIZE * SIZE; ++i) {
        REQUIRE(pixels[4 * i + 3] == 255);
        bright += pixels[4 * i] > 16;
    }
    REQUIRE(bright > SIZE * SIZE / 20 && bright < SIZE * SIZE); /* the floor, not the sky */
}

int main(void) {
    rt_scene_desc desc = rt_default_scene_desc();
    rt_mesh_update update = rt_default_mesh_update();
    rt_commit_report report = rt_default_commit_report();
    rt_scene scene;
    rt_material material;
    rt_mesh ground, lift;
    float corners[12];

    REQUIRE(rt_get_last_error()[0] == '\0');
    OK(rt_create_scene(&desc, &scene));
    material = add_material(scene);
    ground = add_quad(scene, 8.0f, 0.0f, 0, material);
    lift = add_quad(scene, 1.0f, 1.0f, 1, material);
    add_light(scene);
    OK(rt_commit_scene(scene, NULL, &report));
    REQUIRE(report.triangle_count == 4 && report.light_count == 1);
    check_ray_down(scene, 0.5f, 0.5f, ground);
    check_ray_down(scene, 5.0f, 4.0f, lift);

    fill_quad(corners, 1.0f, 2.0f);
    update.positions = floats(corners, 4);
    OK(rt_update_dynamic_mesh(scene, lift, &update));
    check_ray_down(scene, 5.0f, 4.0f, lift); /* not yet committed */
    OK(rt_commit_scene(scene, NULL, NULL));
    check_ray_down(scene, 5.0f, 3.0f, lift);
    check_frame(scene);

    OK(rt_remove_mesh(scene, lift));
    REQUIRE(rt_remove_mesh(scene, lift) == RT_ERROR_INVALID_HANDLE);
    REQUIRE(strstr(rt_get_last_error(), "mesh") != NULL);
    OK(rt_commit_scene(scene, NULL, NULL));
    check_ray_down(scene, 5.0f, 5.0f, ground);
    OK(rt_destroy_scene(scene));
    REQUIRE(rt_destroy_scene(scene) == RT_ERROR_INVALID_HANDLE);
    printf("%s\n", rt_get_version_string());
    return 0;
}
