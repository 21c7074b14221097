#include "support.h"

#include <limits>

namespace peregrine::test {
namespace {

#define TRY(call)                                                                                  \
    if (const rt_result result = (call)) return result

rt_result add_texture(World& world) {
    const std::vector<uint8_t> pixels = {255, 10, 20, 255, 90, 200, 30, 0,
                                         40,  50, 60, 255, 70, 80,  90, 255};
    rt_texture_desc desc = rt_default_texture_desc();
    desc.pixels = pixels.data();
    desc.width = desc.height = 2;
    return rt_add_texture(world.scene, &desc, &world.texture);
}

rt_result add_materials(World& world) {
    rt_material_desc desc = rt_default_material_desc();
    desc.base_color[2] = 0.25f;
    desc.specular[0] = desc.specular[1] = desc.specular[2] = 0.1f;
    desc.user_data = 7;
    TRY(rt_add_material(world.scene, &desc, &world.material));
    desc = rt_default_material_desc();
    desc.alpha_mode = RT_ALPHA_MASK;
    desc.double_sided = 1;
    desc.base_color_texture.texture = world.texture;
    desc.user_data = 8;
    return rt_add_material(world.scene, &desc, &world.fence);
}

rt_result add_ground(World& world) {
    constexpr uint32_t kCells = 8;
    std::vector<float> positions, normals, texcoords;
    std::vector<uint32_t> indices;
    for (uint32_t z = 0; z <= kCells; ++z)
        for (uint32_t x = 0; x <= kCells; ++x) {
            const float px = float(x) - 4.0f, pz = float(z) - 4.0f;
            positions.insert(positions.end(), {px, 0.125f * px * pz * 0.25f, pz});
            normals.insert(normals.end(), {0, 1, 0});
            texcoords.insert(texcoords.end(), {float(x), float(z)});
        }
    for (uint32_t z = 0; z < kCells; ++z)
        for (uint32_t x = 0; x < kCells; ++x) {
            const uint32_t a = z * (kCells + 1) + x, b = a + kCells + 1;
            indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    const std::vector<rt_material> materials(indices.size() / 3, world.material);
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = array_of(positions, positions.size() / 3);
    desc.normals = array_of(normals, normals.size() / 3);
    desc.texcoords = array_of(texcoords, texcoords.size() / 2);
    desc.indices = array_of(indices, indices.size());
    desc.materials = array_of(materials, materials.size());
    desc.user_data = 1;
    desc.layer_mask = 1;
    return rt_add_static_mesh(world.scene, &desc, &world.ground);
}

rt_result add_lift(World& world) {
    const std::vector<float> positions = lift_corners(1);
    const std::vector<float> texcoords = {0, 0, 1, 0, 1, 1, 0, 1};
    const std::vector<uint16_t> indices = {0, 1, 2, 0, 2, 3};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_UINT16;
    desc.positions = array_of(positions, 4);
    desc.texcoords = array_of(texcoords, 4);
    desc.indices = array_of(indices, 6);
    desc.material = world.fence;
    desc.user_data = 2;
    desc.layer_mask = 2;
    return rt_add_dynamic_mesh(world.scene, &desc, &world.lift);
}

rt_result add_lights(World& world) {
    rt_light_desc desc = rt_default_light_desc();
    desc.position[1] = 4;
    desc.intensity[0] = desc.intensity[1] = desc.intensity[2] = 15;
    TRY(rt_add_light(world.scene, &desc, &world.lamp));
    desc = rt_default_light_desc();
    desc.type = RT_LIGHT_DIRECTIONAL;
    desc.direction[0] = 0.5f;
    return rt_add_light(world.scene, &desc, &world.sun);
}

void append(Bytes& bytes, const void* data, size_t size) {
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

} // namespace

std::vector<float> lift_corners(float height) {
    return {-1, height, 1, 1, height, 1, 1, height, -1, -1, height, -1};
}

rt_result describe_world(World& world) {
    TRY(add_texture(world));
    TRY(add_materials(world));
    TRY(add_ground(world));
    TRY(add_lift(world));
    return add_lights(world);
}

rt_result move_lift(const World& world, float height) {
    const std::vector<float> positions = lift_corners(height);
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = array_of(positions, 4);
    return rt_update_dynamic_mesh(world.scene, world.lift, &update);
}

rt_result make_world(World& world, const rt_scene_desc& desc) {
    TRY(rt_create_scene(&desc, &world.scene));
    TRY(describe_world(world));
    return rt_commit_scene(world.scene, nullptr, nullptr);
}

std::vector<rt_ray> world_rays() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::vector<rt_ray> rays;
    for (int z = -5; z <= 5; ++z)
        for (int x = -5; x <= 5; ++x) {
            const float px = 0.4f * float(x), pz = 0.4f * float(z);
            rays.push_back({{px, 6, pz}, 0, {0.03f * pz, -1, 0.05f * px}, kInfinity});
            rays.push_back({{px, 0.5f, pz}, 0, {0, 1, 0}, 0.25f * float(x + 6)});
        }
    return rays;
}

Bytes answers(rt_scene scene) {
    const std::vector<rt_ray> rays = world_rays();
    std::vector<rt_hit> hits(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    std::vector<rt_surface> surfaces(rays.size());
    Bytes bytes;
    rt_query_desc query = rt_default_query_desc();
    query.rays = rays.data();
    query.ray_count = rays.size();
    query.hits = hits.data();
    query.occluded = occluded.data();
    for (const uint32_t flags : {0u, uint32_t(RT_QUERY_ALPHA_TEST)}) {
        query.flags = flags;
        query.kind = RT_QUERY_CLOSEST;
        EXPECT_OK(rt_trace_query(scene, &query));
        EXPECT_OK(rt_resolve_hits(scene, hits.data(), hits.size(), 0, surfaces.data(), 0));
        query.kind = RT_QUERY_ANY;
        EXPECT_OK(rt_trace_query(scene, &query));
        // Handles differ between scenes; whether there is one does not.
        for (rt_hit& hit : hits) hit.mesh.generation = hit.mesh.generation != 0;
        for (rt_surface& surface : surfaces)
            surface.material.generation = surface.material.generation != 0;
        append(bytes, hits.data(), hits.size() * sizeof(rt_hit));
        append(bytes, surfaces.data(), surfaces.size() * sizeof(rt_surface));
        append(bytes, occluded.data(), occluded.size());
    }
    return bytes;
}

rt_camera world_camera() {
    rt_camera camera = rt_default_camera();
    camera.position[1] = 3;
    camera.position[2] = 7;
    camera.forward[1] = -0.4f;
    return camera;
}

Bytes render(rt_scene scene, uint32_t width, uint32_t height) {
    Bytes pixels(size_t(width) * height * 4);
    const rt_camera camera = world_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = width;
    frame.height = height;
    if (rt_render_frame(scene, &camera, &frame, nullptr) != RT_OK) pixels.clear();
    return pixels;
}

} // namespace peregrine::test
