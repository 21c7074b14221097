// A scene takes its memory from the host's allocator and nowhere else. The C++ runtime's operator
// new is replaced here, for the library too, and counts while it must not be called.
#include "support.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> watching{false};
std::atomic<unsigned> calls{0};

void* take(size_t size, size_t alignment) {
    if (watching) ++calls;
    size = (size + alignment - 1) / alignment * alignment;
    if (void* memory = std::aligned_alloc(alignment, size ? size : alignment)) return memory;
    throw std::bad_alloc();
}

} // namespace

// None in line, or GCC sees but one of a new and its delete as what it is, and warns of the pair.
[[gnu::noinline]] void* operator new(size_t size) {
    return take(size, 16);
}
[[gnu::noinline]] void* operator new(size_t size, std::align_val_t alignment) {
    return take(size, size_t(alignment) < 16 ? 16 : size_t(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace peregrine::test {
namespace {

template <class Call>
unsigned news_during(Call&& call) {
    calls = 0;
    watching = true;
    const rt_result result = call();
    watching = false;
    EXPECT_EQ(result, RT_OK) << describe(result);
    return calls;
}

class MemorySource : public testing::TestWithParam<uint32_t> {};

TEST_P(MemorySource, IsTheHostsAllocatorAlone) {
    struct Pool { // of the host, without operator new
        static void* allocate(void*, uint64_t size, uint64_t alignment) {
            alignment = alignment < 16 ? 16 : alignment;
            return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        }
        static void deallocate(void*, void* memory, uint64_t, uint64_t) { std::free(memory); }
    };
    rt_scene_desc desc = rt_default_scene_desc();
    desc.allocator = {nullptr, Pool::allocate, Pool::deallocate};
    desc.worker_count = GetParam();
    World world;
    ASSERT_OK(make_world(world, desc));
    ASSERT_FALSE(answers(world.scene).empty()); // the first query of a thread makes its record
    ASSERT_FALSE(render(world.scene).empty());

    const std::vector<float> corners = lift_corners(2);
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = array_of(corners, 4);
    EXPECT_EQ(news_during([&] { return rt_update_dynamic_mesh(world.scene, world.lift, &update); }),
              0u);
    EXPECT_EQ(news_during([&] { return rt_commit_scene(world.scene, nullptr, nullptr); }), 0u);
    Bytes pixels(64 * 64 * 4);
    const rt_camera camera = world_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = pixels.data();
    frame.width = frame.height = 64;
    EXPECT_EQ(news_during([&] { return rt_render_frame(world.scene, &camera, &frame, nullptr); }),
              0u);
    EXPECT_EQ(news_during([&] { return rt_destroy_scene(world.scene); }), 0u);
}

TEST(OperatorNew, IsCounted) {
    EXPECT_EQ(news_during([] {
                  ::operator delete(::operator new(100));
                  return RT_OK;
              }) > 0,
              true);
}

INSTANTIATE_TEST_SUITE_P(Workers, MemorySource, testing::Values(1u, 3u));

} // namespace
} // namespace peregrine::test
