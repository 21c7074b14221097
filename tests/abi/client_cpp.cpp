// A host in C++11, the oldest that a game engine still uses: textures, a masked material, layers.
#include <peregrine/rt.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void require(bool condition, const char* what, int line) {
    if (condition) return;
    std::fprintf(stderr, "client_cpp.cpp:%d: %s: %s\n", line, what, rt_get_last_error());
    std::exit(1);
}
#define REQUIRE(condition) require((condition), #condition, __LINE__)
#define OK(call) REQUIRE((call) == RT_OK)

template <class T>
rt_array array_of(const std::vector<T>& values, uint64_t count) {
    rt_array array = {};
    array.data = values.data();
    array.count = count;
    return array;
}

// A 2 x 1 texture: the left half is a hole, the right half is there.
rt_texture add_grid(rt_scene scene) {
    const std::vector<uint8_t> pixels = {255, 255, 255, 0, 255, 255, 255, 255};
    rt_texture_desc desc = rt_default_texture_desc();
    desc.pixels = pixels.data();
    desc.width = 2;
    desc.height = 1;
    desc.filter = RT_FILTER_NEAREST;
    rt_texture texture;
    OK(rt_add_texture(scene, &desc, &texture));
    return texture;
}

rt_material add_fence(rt_scene scene) {
    rt_material_desc desc = rt_default_material_desc();
    desc.alpha_mode = RT_ALPHA_MASK;
    desc.double_sided = 1;
    desc.base_color_texture.texture = add_grid(scene);
    rt_material material;
    OK(rt_add_material(scene, &desc, &material));
    return material;
}

// A square from (-1, -1) to (1, 1) in the plane z = 0, facing +z, textured once.
rt_mesh add_square(rt_scene scene, rt_material material) {
    const std::vector<float> positions = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const std::vector<float> texcoords = {0, 0, 1, 0, 1, 1, 0, 1};
    const std::vector<uint32_t> indices = {0, 1, 2, 0, 2, 3};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = array_of(positions, 4);
    desc.texcoords = array_of(texcoords, 4);
    desc.indices = array_of(indices, 6);
    desc.material = material;
    desc.layer_mask = 4;
    rt_mesh mesh;
    OK(rt_add_static_mesh(scene, &desc, &mesh));
    return mesh;
}

uint8_t is_blocked(rt_scene scene, float x, uint32_t flags, uint32_t layers) {
    const rt_ray ray = {{x, 0.25f, 3}, 0, {0, 0, -1}, 10};
    uint8_t occluded = 2;
    rt_query_desc query = rt_default_query_desc();
    query.kind = RT_QUERY_ANY;
    query.rays = &ray;
    query.ray_count = 1;
    query.occluded = &occluded;
    query.flags = flags;
    query.layer_mask = layers;
    OK(rt_trace_query(scene, &query));
    return occluded;
}

void check_frame(rt_scene scene) {
    const uint32_t size = 64;
    std::vector<uint8_t> pixels(size * size * 4);
    rt_camera camera = rt_default_camera();
    camera.position[2] = 3;
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = frame.height = size;
    OK(rt_render_frame(scene, &camera, &frame, nullptr));
    const uint8_t* row = &pixels[(size / 2) * size * 4];
    REQUIRE(row[(size / 2 - 8) * 4] == 0); // through the hole: the black background
    REQUIRE(row[(size / 2 + 8) * 4] > 0);  // the ambient light on the fence
}

} // namespace

int main() {
    const rt_scene_desc desc = rt_default_scene_desc();
    rt_scene scene;
    OK(rt_create_scene(&desc, &scene));
    add_square(scene, add_fence(scene));
    OK(rt_commit_scene(scene, nullptr, nullptr));
    REQUIRE(is_blocked(scene, -0.5f, 0, ~0u) == 1);
    REQUIRE(is_blocked(scene, -0.5f, RT_QUERY_ALPHA_TEST, ~0u) == 0);
    REQUIRE(is_blocked(scene, 0.5f, RT_QUERY_ALPHA_TEST, ~0u) == 1);
    REQUIRE(is_blocked(scene, 0.5f, 0, 3) == 0);
    REQUIRE(is_blocked(scene, 0.5f, 0, 6) == 1);
    check_frame(scene);
    OK(rt_destroy_scene(scene));
    return 0;
}
