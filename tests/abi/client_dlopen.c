/* A host that knows the header alone and loads the library at run time: argv[1] is its path. */
#include <peregrine/rt.h>

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

static const rt_api* api;

#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, #condition,                     \
                    api ? api->get_last_error() : "no api");                                       \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)
#define OK(call) REQUIRE((call) == RT_OK)

static void* load(const char* path) {
    rt_get_api_function get_api;
    void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void* symbol = library ? dlsym(library, "rt_get_api") : NULL;
    if (!symbol) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    memcpy(&get_api, &symbol, sizeof get_api);
    REQUIRE(get_api(0) == NULL);
    REQUIRE(get_api(RT_API_VERSION + 1) == NULL);
    api = get_api(RT_API_VERSION);
    REQUIRE(api != NULL);
    REQUIRE(api->version == RT_API_VERSION && api->struct_size >= sizeof(rt_api));
    return library;
}

static void build(rt_scene scene) {
    static const float corners[] = {-9, -9, 0, 9, -9, 0, 0, 9, 0};
    rt_mesh_desc mesh = rt_default_mesh_desc();
    rt_light_desc sun = rt_default_light_desc();
    rt_environment sky = rt_default_environment();
    rt_mesh triangle;
    rt_light light;
    mesh.index_type = RT_INDEX_NONE;
    mesh.positions.data = corners;
    mesh.positions.count = 3;
    OK(api->add_static_mesh(scene, &mesh, &triangle));
    sun.type = RT_LIGHT_DIRECTIONAL;
    sun.direction[2] = -1.0f;
    OK(api->add_light(scene, &sun, &light));
    sky.background[2] = 1.0f;
    OK(api->set_environment(scene, &sky));
    OK(api->commit_scene(scene, NULL, NULL));
}

static void check_query(rt_scene scene) {
    const rt_ray rays[2] = {{{0, 0, 5}, 0, {0, 0, -2}, 100}, {{50, 0, 5}, 0, {0, 0, -2}, 100}};
    rt_query_desc query = rt_default_query_desc();
    rt_hit hits[2];
    query.rays = rays;
    query.ray_count = 2;
    query.hits = hits;
    OK(api->trace_query(scene, &query));
    REQUIRE(hits[0].t == 2.5f && hits[0].triangle == 0);
    REQUIRE(hits[1].mesh.generation == 0 && hits[1].triangle == RT_NO_TRIANGLE);
}

static void check_frame(rt_scene scene) {
    enum { SIZE = 64 };
    static float pixels[SIZE][SIZE][4];
    rt_camera camera = rt_default_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    camera.position[2] = 20.0;
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    frame.pixels = pixels;
    frame.width = frame.height = SIZE;
    OK(api->render_frame(scene, &camera, &frame, NULL));
    REQUIRE(pixels[0][0][0] == 0.0f && pixels[0][0][2] == 1.0f); /* the blue sky */
    REQUIRE(pixels[SIZE / 2][SIZE / 2][0] > 0.1f);               /* the white triangle */
}

int main(int argc, char** argv) {
    rt_scene_desc desc = rt_default_scene_desc();
    rt_scene scene;
    void* library;
    if (argc != 2) return 2;
    library = load(argv[1]);
    desc.worker_count = 2;
    OK(api->create_scene(&desc, &scene));
    build(scene);
    check_query(scene);
    check_frame(scene);
    REQUIRE(api->add_texture(scene, NULL, NULL) == RT_ERROR_INVALID_ARGUMENT);
    REQUIRE(strcmp(api->get_result_name(RT_ERROR_LIMIT), "RT_ERROR_LIMIT") == 0);
    OK(api->destroy_scene(scene));
    printf("%s\n", api->get_version_string());
    dlclose(library);
    return 0;
}
