// The host's allocator fails at the first, second, third ... allocation of every call.
#include "host_memory.h"
#include "support.h"

#include <functional>

namespace peregrine::test {
namespace {

rt_scene_desc desc_with(TestMemory& memory, uint32_t workers) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.allocator = memory.allocator();
    desc.worker_count = workers;
    return desc;
}

uint32_t object_count(rt_scene scene) {
    rt_scene_stats stats = rt_default_scene_stats();
    EXPECT_OK(rt_get_scene_stats(scene, &stats));
    return stats.mesh_count + stats.material_count + stats.texture_count + stats.light_count;
}

// What the scene shows once the call succeeded and was committed.
struct Outcome {
    Bytes answers, pixels;

    explicit Outcome(rt_scene scene) {
        EXPECT_OK(rt_commit_scene(scene, nullptr, nullptr));
        answers = test::answers(scene);
        pixels = render(scene);
    }
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

class AllocationFailure : public testing::TestWithParam<uint32_t> {
protected:
    using Call = std::function<rt_result(const World&)>;

    // Lets the call fail at its k-th allocation for every k, each time on a scene that then must
    // answer as before and be able to do the call after all.
    // What a failed call leaves idle for the next one is at most `idle` bytes.
    void exhaust(const Call& call, uint64_t fewest, uint64_t idle = 65536) {
        const Outcome expected = outcome_without_failure(call);
        const Outcome before = outcome_without_failure([](const World&) { return RT_OK; });
        uint64_t k = 0;
        for (bool succeeded = false; !succeeded; ++k) {
            ASSERT_LT(k, 100000u) << "it never succeeds";
            succeeded = try_with(k, call, before, expected, idle);
        }
        EXPECT_GT(k, fewest) << "fewer allocations than there must be: is the allocator used?";
    }

private:
    Outcome outcome_without_failure(const Call& call) {
        WorldGuard world;
        EXPECT_OK(call(*world));
        return Outcome(world->scene);
    }

    bool try_with(uint64_t k, const Call& call, const Outcome& before, const Outcome& expected,
                  uint64_t idle) {
        TestMemory memory;
        World world;
        EXPECT_OK(make_world(world, desc_with(memory, GetParam())));
        const uint32_t objects = object_count(world.scene);
        const uint64_t bytes = memory.bytes();

        memory.fail_after(k);
        const rt_result result = call(world);
        memory.fail_after(~uint64_t(0));

        if (result != RT_OK) {
            EXPECT_EQ(result, RT_ERROR_OUT_OF_MEMORY) << describe(result);
            EXPECT_STRNE(rt_get_last_error(), "");
            EXPECT_EQ(object_count(world.scene), objects);
            // Vectors may have grown in vain; that is bounded, and no leak.
            EXPECT_LE(memory.bytes(), bytes + idle);
            EXPECT_EQ(answers(world.scene), before.answers) << "at allocation " << k;
            EXPECT_EQ(render(world.scene), before.pixels);
            EXPECT_OK(call(world));
        }
        EXPECT_TRUE(Outcome(world.scene) == expected) << "at allocation " << k;
        EXPECT_OK(rt_destroy_scene(world.scene));
        EXPECT_EQ(memory.bytes(), 0u);
        return result == RT_OK;
    }
};

TEST_P(AllocationFailure, CreateScene) {
    TestMemory memory;
    const rt_scene_desc desc = desc_with(memory, GetParam());
    for (uint64_t k = 0;; ++k) {
        ASSERT_LT(k, 1000u);
        memory.fail_after(k);
        rt_scene scene = {1, 2};
        const rt_result result = rt_create_scene(&desc, &scene);
        if (result == RT_OK) {
            EXPECT_GT(k, 0u);
            EXPECT_OK(rt_destroy_scene(scene));
            break;
        }
        EXPECT_EQ(result, RT_ERROR_OUT_OF_MEMORY);
        EXPECT_EQ(scene.index, 1u);
        EXPECT_EQ(memory.bytes(), 0u);
    }
    EXPECT_EQ(memory.bytes(), 0u);
}

TEST_P(AllocationFailure, AddTexture) {
    exhaust(
        [](const World& world) {
            const std::vector<uint8_t> pixels(16 * 16 * 4, 200);
            rt_texture_desc desc = rt_default_texture_desc();
            desc.pixels = pixels.data();
            desc.width = desc.height = 16;
            rt_texture texture;
            return rt_add_texture(world.scene, &desc, &texture);
        },
        2);
}

TEST_P(AllocationFailure, AddMaterialAndLight) {
    exhaust(
        [](const World& world) {
            const rt_material_desc desc = rt_default_material_desc();
            rt_material material;
            return rt_add_material(world.scene, &desc, &material);
        },
        1);
    exhaust(
        [](const World& world) {
            const rt_light_desc desc = rt_default_light_desc();
            rt_light light;
            return rt_add_light(world.scene, &desc, &light);
        },
        1);
}

rt_result add_triangle(const World& world, bool dynamic) {
    const std::vector<float> positions = {0, 2, 0, 0, 2, 1, 1, 2, 0};
    const std::vector<float> normals = {0, 1, 0, 0, 1, 0, 0, 1, 0};
    const std::vector<rt_material> materials = {world.material};
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(positions, 3);
    desc.normals = array_of(normals, 3);
    desc.materials = array_of(materials, 1);
    rt_mesh mesh;
    return dynamic ? rt_add_dynamic_mesh(world.scene, &desc, &mesh)
                   : rt_add_static_mesh(world.scene, &desc, &mesh);
}

TEST_P(AllocationFailure, AddMesh) {
    exhaust([](const World& world) { return add_triangle(world, false); }, 5);
    exhaust([](const World& world) { return add_triangle(world, true); }, 5);
}

// Many enough that threads build parts of the structure.
TEST_P(AllocationFailure, UpdateOfManyTrianglesAndCommit) {
    constexpr uint32_t kTriangles = 1500;
    std::vector<float> corners(9 * kTriangles);
    for (size_t i = 0; i < corners.size(); ++i) corners[i] = float(i * 7919 % 101) * 0.01f;
    std::vector<float> moved = corners;
    for (float& coordinate : moved) coordinate += 3;
    const auto call = [&](const World& world) {
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.index_type = RT_INDEX_NONE;
        desc.positions = array_of(corners, 3 * kTriangles);
        rt_mesh mesh;
        if (const rt_result result = rt_add_dynamic_mesh(world.scene, &desc, &mesh)) return result;
        rt_mesh_update update = rt_default_mesh_update();
        update.positions = array_of(moved, 3 * kTriangles);
        rt_result result = rt_update_dynamic_mesh(world.scene, mesh, &update);
        if (!result) result = rt_commit_scene(world.scene, nullptr, nullptr);
        if (result) rt_remove_mesh(world.scene, mesh);
        return result;
    };
    exhaust(call, 20, 1 << 20);
}

TEST_P(AllocationFailure, CompactCommit) {
    exhaust(
        [](const World& world) {
            rt_commit_desc desc = rt_default_commit_desc();
            desc.memory = RT_MEMORY_COMPACT;
            return rt_commit_scene(world.scene, &desc, nullptr);
        },
        10);
}

TEST_P(AllocationFailure, CommitAfterAMove) {
    exhaust(
        [](const World& world) {
            if (const rt_result result = move_lift(world, 1.5f)) return result;
            return rt_commit_scene(world.scene, nullptr, nullptr);
        },
        10);
}

TEST_P(AllocationFailure, RigidMeshAndInstance) {
    exhaust(
        [](const World& world) {
            const std::vector<float> positions = {1, 2, 3, 4, 2, 3, 1, 2, 6};
            rt_mesh_desc desc = rt_default_mesh_desc();
            desc.index_type = RT_INDEX_NONE;
            desc.positions = array_of(positions, 3);
            rt_mesh mesh, instance;
            if (const rt_result result = rt_add_rigid_mesh(world.scene, &desc, &mesh))
                return result;
            rt_result result = rt_add_mesh_instance(world.scene, mesh, &instance);
            if (!result) {
                result = rt_commit_scene(world.scene, nullptr, nullptr);
                rt_remove_mesh(world.scene, instance);
            }
            rt_remove_mesh(world.scene, mesh);
            return result;
        },
        10);
}

TEST_P(AllocationFailure, Remove) {
    exhaust([](const World& world) { return rt_remove_light(world.scene, world.lamp); }, 0);
    exhaust([](const World& world) { return rt_remove_mesh(world.scene, world.lift); }, 0);
}

// What a thread works with is kept for the next frame.
constexpr uint64_t kFrameMemory = 330'000;

TEST_P(AllocationFailure, RenderFrame) {
    exhaust(
        [](const World& world) {
            Bytes pixels(48 * 40 * 4, 0x77);
            const rt_camera camera = world_camera();
            rt_frame_desc frame = rt_default_frame_desc();
            frame.pixels = pixels.data();
            frame.width = 48;
            frame.height = 40;
            const rt_result result = rt_render_frame(world.scene, &camera, &frame, nullptr);
            EXPECT_TRUE(result == RT_OK || pixels == Bytes(48 * 40 * 4, 0x77)) << "pixels written";
            return result;
        },
        1, GetParam() * kFrameMemory);
}

TEST_P(AllocationFailure, QueriesNeedNoMemory) {
    TestMemory memory;
    World world;
    ASSERT_OK(make_world(world, desc_with(memory, GetParam())));
    const Bytes before = answers(world.scene);
    memory.fail_after(0);
    EXPECT_EQ(answers(world.scene), before);
    memory.fail_after(~uint64_t(0));
    EXPECT_OK(rt_destroy_scene(world.scene));
}

TEST_P(AllocationFailure, ThousandsOfObjectsComeAndGoWithoutALeak) {
    TestMemory memory;
    World world;
    ASSERT_OK(make_world(world, desc_with(memory, GetParam())));
    uint64_t bytes_after_first = 0;
    for (int round = 0; round < 40; ++round) {
        ASSERT_OK(move_lift(world, 1 + 0.01f * float(round)));
        ASSERT_OK(rt_commit_scene(world.scene, nullptr, nullptr));
        rt_scene_stats stats = rt_default_scene_stats();
        ASSERT_OK(rt_get_scene_stats(world.scene, &stats));
        EXPECT_EQ(stats.snapshots_alive, 1u);
        EXPECT_LE(stats.bytes_allocated, memory.bytes());
        if (round == 8) bytes_after_first = memory.bytes();
    }
    EXPECT_LE(memory.bytes(), bytes_after_first + bytes_after_first / 10);
    EXPECT_OK(rt_destroy_scene(world.scene));
}

INSTANTIATE_TEST_SUITE_P(Workers, AllocationFailure, testing::Values(1u, 3u));

} // namespace
} // namespace peregrine::test
