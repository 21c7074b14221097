// What shading programs of the host are given.
#include "program_world.h"

#include <cmath>
#include <mutex>
#include <utility>

namespace peregrine::test {
namespace {

// What a program was given of each hit, and whether its arrays are as they should be.
struct Recorder {
    struct Hit {
        float position[3], normal[3], direction[3], distance, footprint, texcoord[2], u, v;
        uint32_t triangle, back_face;
        rt_mesh mesh;
        uint64_t mesh_user_data, material_user_data;
        float openness;
    };
    std::mutex mutex;
    std::vector<Hit> hits;
    bool sound = true;

    static void shade(void* user, const rt_program_batch* hits) {
        static_cast<Recorder*>(user)->record(*hits);
    }

    void check(const void* array, size_t element, uint32_t count, uint32_t padded) {
        const auto* bytes = static_cast<const unsigned char*>(array);
        sound = sound && reinterpret_cast<uintptr_t>(array) % 64 == 0;
        for (uint32_t i = count; i < padded; ++i)
            sound =
                sound
                && std::memcmp(bytes + i * element, bytes + (count - 1) * element, element) == 0;
    }

    void record(const rt_program_batch& b) {
        const std::lock_guard lock(mutex);
        sound = sound && b.struct_size == sizeof b && b.count > 0 && b.padded_count % 16 == 0
                && b.padded_count - b.count < 16 && b.reserved == 0;
        for (const auto& lanes : {b.position, b.geometric_normal, b.shading_normal, b.direction,
                                  b.base_color, b.emissive, b.diffuse, b.highlight})
            for (int k = 0; k < 3; ++k) check(lanes[k], 4, b.count, b.padded_count);
        for (const float* lanes : {b.distance, b.footprint, b.texcoord[0], b.texcoord[1],
                                   b.barycentric[0], b.barycentric[1], b.openness})
            check(lanes, 4, b.count, b.padded_count);
        check(b.triangle, 4, b.count, b.padded_count);
        check(b.back_face, 4, b.count, b.padded_count);
        check(b.mesh, 8, b.count, b.padded_count);
        check(b.mesh_user_data, 8, b.count, b.padded_count);
        check(b.material_user_data, 8, b.count, b.padded_count);
        for (const auto& lanes : {b.radiance, b.ray_direction, b.ray_weight})
            for (int k = 0; k < 3; ++k)
                for (uint32_t i = 0; i < b.padded_count; ++i)
                    sound = sound && std::exchange(lanes[k][i], 0.5f) == 0;
        for (uint32_t i = 0; i < b.count; ++i) {
            Hit& hit = hits.emplace_back();
            for (int k = 0; k < 3; ++k) {
                hit.position[k] = b.position[k][i];
                hit.normal[k] = b.geometric_normal[k][i];
                hit.direction[k] = b.direction[k][i];
            }
            hit.distance = b.distance[i];
            hit.footprint = b.footprint[i];
            hit.texcoord[0] = b.texcoord[0][i];
            hit.texcoord[1] = b.texcoord[1][i];
            hit.u = b.barycentric[0][i];
            hit.v = b.barycentric[1][i];
            hit.triangle = b.triangle[i];
            hit.back_face = b.back_face[i];
            hit.mesh = b.mesh[i];
            hit.mesh_user_data = b.mesh_user_data[i];
            hit.material_user_data = b.material_user_data[i];
            hit.openness = b.openness[i];
        }
    }
};

// `error`: metres.
void expect_surface(const World& world, const rt_camera& camera, const Recorder::Hit& hit,
                    double error) {
    rt_hit record{};
    record.t = 1;
    record.u = hit.u;
    record.v = hit.v;
    record.triangle = hit.triangle;
    record.mesh = hit.mesh;
    rt_surface surface;
    ASSERT_OK(rt_resolve_hits(world.scene, &record, 1, 0, &surface, 0));
    double length = 0;
    for (int k = 0; k < 3; ++k) {
        const double way = surface.position[k] - camera.position[k];
        ASSERT_NEAR(double(hit.position[k]), surface.position[k], error);
        ASSERT_NEAR(double(hit.direction[k] * hit.distance), way, 2 * error);
        const float side = hit.back_face ? -1.0f : 1.0f;
        ASSERT_NEAR(hit.normal[k], surface.geometric_normal[k] * side, 1e-5f);
        length += double(hit.direction[k]) * double(hit.direction[k]);
    }
    ASSERT_NEAR(length, 1, 1e-6);
    ASSERT_NEAR(hit.texcoord[0], surface.texcoord[0], 1e-6f);
    ASSERT_NEAR(hit.texcoord[1], surface.texcoord[1], 1e-6f);
    ASSERT_EQ(hit.mesh.index, world.ground.index);
    ASSERT_EQ(hit.mesh.generation, world.ground.generation);
    ASSERT_EQ(hit.mesh_user_data, 1u);
    ASSERT_EQ(hit.material_user_data, 7u);
    ASSERT_EQ(hit.openness, 1.0f);
    const float pixel = 2 * std::tan(0.5f * camera.vertical_fov) / kHeight;
    ASSERT_GT(hit.footprint, 0.7f * pixel * hit.distance);
    ASSERT_LT(hit.footprint, 1.01f * pixel * hit.distance);
}

void expect_surfaces(const World& world, const rt_camera& camera, double error) {
    Recorder recorder;
    cover_ground(world, shaded_by(add_program(world.scene, kAll, Recorder::shade, &recorder)));
    rt_frame_desc frame = rt_default_frame_desc();
    frame.max_depth = 0;
    const uint64_t hit_count = render_radiance(world.scene, frame, camera).stats.program_hits;
    EXPECT_EQ(hit_count, recorder.hits.size());
    EXPECT_TRUE(recorder.sound);
    ASSERT_GT(recorder.hits.size(), 500u);
    for (const Recorder::Hit& hit : recorder.hits) expect_surface(world, camera, hit, error);
}

TEST(ProgramBatch, HasWhatLiesAtTheHits) {
    rt_scene_desc threads = rt_default_scene_desc();
    threads.worker_count = 3;
    const WorldGuard world(threads);
    expect_surfaces(*world, world_camera(), 5e-5);
}

// Where frames shade relative to the eye: a rigid mesh is there, and the world's origin is far.
TEST(ProgramBatch, HasPositionsFromTheWorldsOriginWhereverTheEyeIs) {
    const WorldGuard world;
    const std::vector<float> corners = {0, -50, 0, 1, -50, 0, 0, -50, 1};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(corners, 3);
    rt_mesh mesh;
    ASSERT_OK(rt_add_rigid_mesh((*world).scene, &desc, &mesh));
    rt_camera camera = world_camera();
    camera.position[1] = 1000;
    camera.position[2] = 2500;
    camera.vertical_fov = 0.003f;
    expect_surfaces(*world, camera, 1e-3);
}

// Notes which pointers are null, as a bit of each.
void note_fields(void* user, const rt_program_batch* b) {
    const void* const fields[] = {
        b->position[2],   b->geometric_normal[0], b->shading_normal[1], b->direction[0],
        b->distance,      b->footprint,           b->texcoord[1],       b->barycentric[0],
        b->triangle,      b->back_face,           b->mesh_user_data,    b->base_color[2],
        b->emissive[0],   b->diffuse[1],          b->highlight[0],      b->openness,
        b->ray_weight[0],
    };
    uint32_t found = 0;
    for (uint32_t i = 0; i < std::size(fields); ++i) found |= uint32_t(fields[i] != nullptr) << i;
    const bool pairs = (b->triangle == nullptr) == (b->mesh == nullptr)
                       && (b->mesh_user_data == nullptr) == (b->material_user_data == nullptr)
                       && (b->ray_weight[0] == nullptr) == (b->ray_direction[2] == nullptr);
    *static_cast<uint32_t*>(user) = pairs && b->radiance[0] ? found : ~0u;
}

TEST(ProgramBatch, HasWhatIsAskedForAlone) {
    for (uint32_t bit = 0; bit <= 17; ++bit) {
        const uint32_t fields = bit < 17 ? 1u << bit : 0;
        WorldGuard world;
        uint32_t found = ~0u;
        cover_ground(*world, shaded_by(add_program(world->scene, fields, note_fields, &found)));
        render_radiance(world->scene);
        EXPECT_EQ(found, fields) << bit;
    }
}

} // namespace
} // namespace peregrine::test
