#include "bad_input.h"

namespace peregrine::test {
namespace {

class BadHandle : public BadInput {};

// Calls everything that takes a scene with one that is none; arguments are otherwise fine.
void expect_all_refuse(rt_scene scene, const World& world, const std::string& words) {
    const rt_texture_desc texture = rt_default_texture_desc();
    const rt_program_desc program = rt_default_program_desc();
    const rt_material_desc material = rt_default_material_desc();
    const rt_mesh_desc mesh = rt_default_mesh_desc();
    const rt_mesh_update update = rt_default_mesh_update();
    const rt_light_desc light = rt_default_light_desc();
    const rt_fog fog = rt_default_fog();
    const rt_environment environment = rt_default_environment();
    const rt_query_desc query = rt_default_query_desc();
    const rt_camera camera = rt_default_camera();
    const rt_frame_desc frame = rt_default_frame_desc();
    rt_scene_stats stats = rt_default_scene_stats();
    auto out_texture = kUntouched<rt_texture>;
    auto out_program = kUntouched<rt_program>;
    auto out_material = kUntouched<rt_material>;
    auto out_mesh = kUntouched<rt_mesh>;
    auto out_light = kUntouched<rt_light>;
    const rt_result results[] = {
        rt_add_texture(scene, &texture, &out_texture),
        rt_remove_texture(scene, world.texture),
        rt_add_program(scene, &program, &out_program),
        rt_remove_program(scene, {1, 1}),
        rt_add_material(scene, &material, &out_material),
        rt_update_material(scene, world.material, &material),
        rt_remove_material(scene, world.material),
        rt_add_static_mesh(scene, &mesh, &out_mesh),
        rt_add_dynamic_mesh(scene, &mesh, &out_mesh),
        rt_update_dynamic_mesh(scene, world.lift, &update),
        rt_remove_mesh(scene, world.lift),
        rt_add_light(scene, &light, &out_light),
        rt_update_light(scene, world.lamp, &light),
        rt_remove_light(scene, world.lamp),
        rt_set_environment(scene, &environment),
        rt_set_fog(scene, &fog),
        rt_commit_scene(scene, nullptr, nullptr),
        rt_bake_light(scene, nullptr, nullptr),
        rt_trace_query(scene, &query),
        rt_resolve_hits(scene, nullptr, 0, 0, nullptr, 0),
        rt_render_frame(scene, &camera, &frame, nullptr),
        rt_get_scene_stats(scene, &stats),
        rt_destroy_scene(scene),
    };
    for (const rt_result result : results) EXPECT_EQ(result, RT_ERROR_INVALID_HANDLE);
    EXPECT_NE(std::string(rt_get_last_error()).find(words), std::string::npos);
    EXPECT_TRUE(untouched(out_texture) && untouched(out_material) && untouched(out_mesh)
                && untouched(out_light) && untouched(out_program));
}

TEST_F(BadHandle, NullScene) {
    expect_all_refuse({0, 0}, *world_, "rt_scene is null");
}

TEST_F(BadHandle, SceneThatNeverWas) {
    expect_all_refuse({1023, 1}, *world_, "rt_scene {1023, 1}");
    expect_all_refuse({1024, 1}, *world_, "rt_scene {1024, 1}");
    expect_all_refuse({0xffffffff, 0xffffffff}, *world_, "rt_scene {4294967295, 4294967295}");
    expect_all_refuse({scene().index, 0}, *world_, "rt_scene is null");
}

TEST_F(BadHandle, DestroyedScene) {
    rt_scene scene{};
    const rt_scene_desc desc = rt_default_scene_desc();
    ASSERT_OK(rt_create_scene(&desc, &scene));
    ASSERT_OK(rt_destroy_scene(scene));
    expect_all_refuse(scene, *world_, "destroyed");
    rt_scene next{};
    ASSERT_OK(rt_create_scene(&desc, &next));
    EXPECT_EQ(next.index, scene.index) << "the slot is used again, and yet";
    expect_all_refuse(scene, *world_, "destroyed");
    ASSERT_OK(rt_destroy_scene(next));
}

TEST_F(BadHandle, OneSceneTooMany) {
    const rt_scene_desc desc = rt_default_scene_desc();
    std::vector<rt_scene> scenes;
    rt_scene scene = kUntouched<rt_scene>;
    rt_result result;
    while ((result = rt_create_scene(&desc, &scene)) == RT_OK) {
        scenes.push_back(scene);
        scene = kUntouched<rt_scene>;
    }
    EXPECT_EQ(scenes.size(), 1023u) << "and the world";
    EXPECT_TRUE(untouched(scene));
    expect_refused(result, RT_ERROR_LIMIT, "1024 scenes");
    for (const rt_scene one : scenes) EXPECT_OK(rt_destroy_scene(one));
}

// Objects: null, of a slot that never was, of a generation that never was, and removed.
template <class Handle, class Call>
std::vector<rt_result> with_bad_handles(Handle good, Call&& call) {
    return {call(Handle{0, 0}), call(Handle{good.index + 1000, 1}),
            call(Handle{0xffffffff, 0xffffffff}), call(Handle{good.index, good.generation + 1}),
            call(Handle{good.index, 0})};
}

TEST_F(BadHandle, Textures) {
    for (const rt_result result : with_bad_handles(
             world_->texture, [&](rt_texture t) { return rt_remove_texture(scene(), t); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_texture");
    rt_material_desc desc = rt_default_material_desc();
    desc.normal_texture.texture = {77, 1};
    auto material = kUntouched<rt_material>;
    expect_refused(rt_add_material(scene(), &desc, &material), RT_ERROR_INVALID_HANDLE,
                   "rt_material_desc.normal_texture.texture is {77, 1}");
    EXPECT_TRUE(untouched(material));
    expect_refused(rt_update_material(scene(), world_->material, &desc), RT_ERROR_INVALID_HANDLE,
                   "rt_material_desc.normal_texture.texture is {77, 1}");
}

TEST_F(BadHandle, Materials) {
    const rt_material_desc desc = rt_default_material_desc();
    for (const rt_result result : with_bad_handles(
             world_->material, [&](rt_material m) { return rt_remove_material(scene(), m); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_material");
    for (const rt_result result : with_bad_handles(world_->material, [&](rt_material m) {
             return rt_update_material(scene(), m, &desc);
         }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_material");
}

TEST_F(BadHandle, Programs) {
    rt_program_desc desc = rt_default_program_desc();
    desc.shade = [](void*, const rt_program_batch*) {};
    rt_program program{};
    ASSERT_OK(rt_add_program(scene(), &desc, &program));
    rt_material_desc material = rt_default_material_desc();
    auto out = kUntouched<rt_material>;
    for (const rt_result result :
         with_bad_handles(program, [&](rt_program p) { return rt_remove_program(scene(), p); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_program");
    ASSERT_OK(rt_remove_program(scene(), program));
    for (const rt_program bad : {program, rt_program{77, 1}, rt_program{0, 1}, rt_program{1, 0}}) {
        material.program = bad;
        expect_refused(rt_add_material(scene(), &material, &out), RT_ERROR_INVALID_HANDLE,
                       "rt_material_desc.program is");
        expect_refused(rt_update_material(scene(), world_->material, &material),
                       RT_ERROR_INVALID_HANDLE, "rt_material_desc.program is");
        EXPECT_TRUE(untouched(out));
    }
}

TEST_F(BadHandle, Meshes) {
    rt_mesh_update update = rt_default_mesh_update();
    for (const rt_result result :
         with_bad_handles(world_->lift, [&](rt_mesh m) { return rt_remove_mesh(scene(), m); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_mesh");
    for (const rt_result result : with_bad_handles(
             world_->lift, [&](rt_mesh m) { return rt_update_dynamic_mesh(scene(), m, &update); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_mesh");
    expect_refused(rt_update_dynamic_mesh(scene(), world_->ground, &update),
                   RT_ERROR_INVALID_ARGUMENT, "static");
}

TEST_F(BadHandle, Lights) {
    const rt_light_desc desc = rt_default_light_desc();
    for (const rt_result result :
         with_bad_handles(world_->lamp, [&](rt_light l) { return rt_remove_light(scene(), l); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_light");
    for (const rt_result result : with_bad_handles(
             world_->lamp, [&](rt_light l) { return rt_update_light(scene(), l, &desc); }))
        expect_refused(result, RT_ERROR_INVALID_HANDLE, "rt_light");
}

TEST(StaleHandle, RemovedObjectsAreRefusedThoughTheirSlotIsUsedAgain) {
    WorldGuard world;
    const rt_light_desc desc = rt_default_light_desc();
    ASSERT_OK(rt_remove_light(world->scene, world->lamp));
    rt_light next{};
    ASSERT_OK(rt_add_light(world->scene, &desc, &next));
    EXPECT_EQ(next.index, world->lamp.index);
    EXPECT_EQ(rt_remove_light(world->scene, world->lamp), RT_ERROR_INVALID_HANDLE);
    EXPECT_OK(rt_remove_light(world->scene, next));
}

TEST(StaleHandle, RemovedTextureIsRefusedByTheCommitAndTheOldSnapshotStays) {
    WorldGuard world;
    const Bytes before = answers(world->scene);
    ASSERT_OK(rt_remove_texture(world->scene, world->texture));
    EXPECT_EQ(rt_commit_scene(world->scene, nullptr, nullptr), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(rt_get_last_error()).find("texture"), std::string::npos);
    EXPECT_EQ(answers(world->scene), before);
    ASSERT_OK(rt_remove_material(world->scene, world->fence));
    EXPECT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
}

TEST(StaleHandle, ProgramsThatMaterialsHaveAreNotRemoved) {
    WorldGuard world;
    rt_program_desc desc = rt_default_program_desc();
    desc.shade = [](void*, const rt_program_batch*) {};
    rt_material_desc material = rt_default_material_desc();
    ASSERT_OK(rt_add_program(world->scene, &desc, &material.program));
    ASSERT_OK(rt_update_material(world->scene, world->fence, &material));
    EXPECT_EQ(rt_remove_program(world->scene, material.program), RT_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(rt_get_last_error()).find("which material {1, "), std::string::npos);
    EXPECT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    ASSERT_OK(rt_remove_material(world->scene, world->fence));
    EXPECT_OK(rt_remove_program(world->scene, material.program));
    EXPECT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
}

TEST(StaleHandle, RemovedMeshIsServedUntilTheCommitAndItsHitsNotAfter) {
    WorldGuard world;
    const rt_ray ray = {{0, 5, 0}, 0, {0, -1, 0}, kInfinity};
    rt_hit hit;
    rt_surface surface;
    rt_query_desc query = rt_default_query_desc();
    query.rays = &ray;
    query.ray_count = 1;
    query.hits = &hit;
    ASSERT_OK(rt_remove_mesh(world->scene, world->lift));
    ASSERT_OK(rt_trace_query(world->scene, &query));
    EXPECT_EQ(hit.t, 4);
    EXPECT_OK(rt_resolve_hits(world->scene, &hit, 1, 0, &surface, 0));
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    EXPECT_EQ(rt_resolve_hits(world->scene, &hit, 1, 0, &surface, 0), RT_ERROR_INVALID_HANDLE);
    query.ignore_mesh = world->lift; // ignores nothing
    ASSERT_OK(rt_trace_query(world->scene, &query));
    EXPECT_EQ(hit.t, 5);
}

} // namespace
} // namespace peregrine::test
