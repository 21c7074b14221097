#include "bad_input.h"

#include <functional>

namespace peregrine::test {
namespace {

class BadStruct : public BadInput {
protected:
    // Hands `call` the struct with sizes that it never had, and one from a newer header.
    template <class Struct>
    void check_sizes(const Struct& good, const std::string& name,
                     const std::function<rt_result(const Struct*)>& call, bool optional = false) {
        struct Newer {
            Struct known;
            uint64_t tail[4];
        } newer = {good, {}};
        constexpr uint32_t kSize = sizeof(Struct);
        for (const uint32_t size : {0u, 1u, 3u, kSize - 4, kSize - 1, kSize + 1, kSize + 4096,
                                    0xccccccccu, 0xffffffffu}) {
            newer.known.struct_size = size;
            expect_refused(call(&newer.known), RT_ERROR_INVALID_STRUCT, name + ".struct_size");
        }
        newer.known.struct_size = sizeof newer;
        newer.tail[2] = 1;
        expect_refused(call(&newer.known), RT_ERROR_INVALID_STRUCT, "newer library");
        newer.tail[2] = 0;
        EXPECT_OK(call(&newer.known));
        if (optional)
            EXPECT_OK(call(nullptr));
        else
            expect_refused(call(nullptr), RT_ERROR_INVALID_ARGUMENT, name + " is null");
    }

    // As above, of a struct that the library fills: its tail is zeroed, its size stays.
    template <class Struct>
    void check_output(const Struct& good, const std::string& name,
                      const std::function<rt_result(Struct*)>& call) {
        struct Newer {
            Struct known;
            uint64_t tail[4];
            uint64_t beyond;
        } newer = {good, {9, 9, 9, 9}, 9};
        for (const uint32_t size : {0u, 1u, uint32_t(sizeof(Struct)) - 4, 0xffffffffu}) {
            newer.known.struct_size = size;
            expect_refused(call(&newer.known), RT_ERROR_INVALID_STRUCT, name + ".struct_size");
            EXPECT_EQ(newer.tail[0], 9u);
        }
        newer.known.struct_size = offsetof(Newer, beyond);
        EXPECT_OK(call(&newer.known));
        EXPECT_EQ(newer.known.struct_size, offsetof(Newer, beyond));
        EXPECT_EQ(newer.tail[0], 0u);
        EXPECT_EQ(newer.tail[3], 0u);
        EXPECT_EQ(newer.beyond, 9u);
    }
};

TEST_F(BadStruct, Scene) {
    check_sizes<rt_scene_desc>(rt_default_scene_desc(), "rt_scene_desc",
                               [](const rt_scene_desc* desc) {
                                   rt_scene scene = kUntouched<rt_scene>;
                                   const rt_result result = rt_create_scene(desc, &scene);
                                   EXPECT_NE(untouched(scene), result == RT_OK);
                                   return result ? result : rt_destroy_scene(scene);
                               });
    check_output<rt_scene_stats>(
        rt_default_scene_stats(), "rt_scene_stats",
        [&](rt_scene_stats* stats) { return rt_get_scene_stats(scene(), stats); });
}

TEST_F(BadStruct, Texture) {
    const uint32_t texel = 0;
    rt_texture_desc desc = rt_default_texture_desc();
    desc.pixels = &texel;
    desc.width = desc.height = 1;
    check_sizes<rt_texture_desc>(desc, "rt_texture_desc", [&](const rt_texture_desc* d) {
        auto texture = kUntouched<rt_texture>;
        const rt_result result = rt_add_texture(scene(), d, &texture);
        EXPECT_NE(untouched(texture), result == RT_OK);
        return result ? result : rt_remove_texture(scene(), texture);
    });
}

TEST_F(BadStruct, Material) {
    check_sizes<rt_material_desc>(
        rt_default_material_desc(), "rt_material_desc", [&](const rt_material_desc* d) {
            auto material = kUntouched<rt_material>;
            const rt_result result = rt_add_material(scene(), d, &material);
            EXPECT_NE(untouched(material), result == RT_OK);
            return result ? result : rt_remove_material(scene(), material);
        });
}

TEST_F(BadStruct, Program) {
    rt_program_desc desc = rt_default_program_desc();
    desc.shade = [](void*, const rt_program_batch*) {};
    check_sizes<rt_program_desc>(desc, "rt_program_desc", [&](const rt_program_desc* d) {
        auto program = kUntouched<rt_program>;
        const rt_result result = rt_add_program(scene(), d, &program);
        EXPECT_NE(untouched(program), result == RT_OK);
        return result ? result : rt_remove_program(scene(), program);
    });
}

TEST_F(BadStruct, Mesh) {
    const float corners[9] = {0, 90, 0, 1, 90, 0, 0, 90, 1};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = {corners, 3, 0, 0};
    for (const auto add : {rt_add_static_mesh, rt_add_dynamic_mesh})
        check_sizes<rt_mesh_desc>(desc, "rt_mesh_desc", [&](const rt_mesh_desc* d) {
            auto mesh = kUntouched<rt_mesh>;
            const rt_result result = add(scene(), d, &mesh);
            EXPECT_NE(untouched(mesh), result == RT_OK);
            return result ? result : rt_remove_mesh(scene(), mesh);
        });
    check_sizes<rt_mesh_update>(
        rt_default_mesh_update(), "rt_mesh_update",
        [&](const rt_mesh_update* d) { return rt_update_dynamic_mesh(scene(), world_->lift, d); });
}

TEST_F(BadStruct, LightAndEnvironment) {
    check_sizes<rt_light_desc>(rt_default_light_desc(), "rt_light_desc",
                               [&](const rt_light_desc* d) {
                                   auto light = kUntouched<rt_light>;
                                   const rt_result result = rt_add_light(scene(), d, &light);
                                   EXPECT_NE(untouched(light), result == RT_OK);
                                   return result ? result : rt_remove_light(scene(), light);
                               });
    check_sizes<rt_environment>(
        rt_default_environment(), "rt_environment",
        [&](const rt_environment* d) { return rt_set_environment(scene(), d); });
    rt_fog none = rt_default_fog();
    none.density = 0;
    check_sizes<rt_fog>(none, "rt_fog", [&](const rt_fog* d) { return rt_set_fog(scene(), d); });
}

TEST_F(BadStruct, QueryAndFrame) {
    check_sizes<rt_query_desc>(rt_default_query_desc(), "rt_query_desc",
                               [&](const rt_query_desc* d) { return rt_trace_query(scene(), d); });
    uint32_t pixel = 0;
    const rt_camera camera = world_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = &pixel;
    frame.width = frame.height = 1;
    check_sizes<rt_camera>(camera, "rt_camera", [&](const rt_camera* c) {
        return rt_render_frame(scene(), c, &frame, nullptr);
    });
    check_sizes<rt_frame_desc>(frame, "rt_frame_desc", [&](const rt_frame_desc* d) {
        return rt_render_frame(scene(), &camera, d, nullptr);
    });
    check_output<rt_frame_stats>(
        rt_default_frame_stats(), "rt_frame_stats",
        [&](rt_frame_stats* stats) { return rt_render_frame(scene(), &camera, &frame, stats); });
}

TEST_F(BadStruct, Bake) {
    rt_bake_desc desc = rt_default_bake_desc();
    desc.samples = 1;
    desc.spacing = 100;
    check_sizes<rt_bake_desc>(
        desc, "rt_bake_desc",
        [&](const rt_bake_desc* d) { return rt_bake_light(scene(), d, nullptr); },
        /*optional=*/true);
    check_output<rt_bake_report>(
        rt_default_bake_report(), "rt_bake_report",
        [&](rt_bake_report* report) { return rt_bake_light(scene(), &desc, report); });
}

TEST_F(BadStruct, Exposure) {
    check_sizes<rt_exposure>(rt_default_exposure(), "rt_exposure", [](const rt_exposure* e) {
        return rt_adapt_exposure(const_cast<rt_exposure*>(e), 0.1f, 0.1f);
    });
}

TEST_F(BadStruct, Governor) {
    rt_frame_desc frame = rt_default_frame_desc();
    rt_governor governor = rt_default_governor();
    check_sizes<rt_governor>(governor, "rt_governor", [&](const rt_governor* g) {
        return rt_govern_frame(const_cast<rt_governor*>(g), &frame, nullptr);
    });
    check_sizes<rt_frame_desc>(frame, "rt_frame_desc", [&](const rt_frame_desc* f) {
        return rt_govern_frame(&governor, const_cast<rt_frame_desc*>(f), nullptr);
    });
    rt_frame_stats last = rt_default_frame_stats();
    last.struct_size = 3;
    expect_refused(rt_govern_frame(&governor, &frame, &last), RT_ERROR_INVALID_STRUCT,
                   "rt_frame_stats.struct_size");
    frame.struct_size = 128; // of a header without the fields
    expect_refused(rt_govern_frame(&governor, &frame, nullptr), RT_ERROR_INVALID_STRUCT,
                   "a frame to govern");
}

// Commits succeed in between, so the world's version moves: a scene of its own.
TEST(CommitStruct, Sizes) {
    WorldGuard world;
    struct Newer {
        rt_commit_desc known;
        uint64_t tail;
    } newer = {rt_default_commit_desc(), 0};
    for (const uint32_t size : {0u, 1u, 20u, 25u}) {
        newer.known.struct_size = size;
        EXPECT_EQ(rt_commit_scene(world->scene, &newer.known, nullptr), RT_ERROR_INVALID_STRUCT);
    }
    newer.known.struct_size = sizeof newer;
    EXPECT_OK(rt_commit_scene(world->scene, &newer.known, nullptr));
    rt_commit_report report = rt_default_commit_report();
    report.struct_size = 8;
    EXPECT_EQ(rt_commit_scene(world->scene, nullptr, &report), RT_ERROR_INVALID_STRUCT);
    EXPECT_EQ(report.triangle_count, 0u);
    report.struct_size = sizeof report;
    EXPECT_OK(rt_commit_scene(world->scene, nullptr, &report));
    EXPECT_EQ(report.triangle_count, 130u);
    EXPECT_EQ(report.rebuilt, 0u);
}

} // namespace
} // namespace peregrine::test
