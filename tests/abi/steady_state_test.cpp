// A world that moves and keeps its size: after a few commits the host's allocator is left alone,
// also while readers hold on to old snapshots.
#include "host_memory.h"
#include "support.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <thread>

namespace peregrine::test {
namespace {

constexpr uint32_t kCells = 32; // of the flag, along a side
constexpr uint32_t kVertices = (kCells + 1) * (kCells + 1);
constexpr uint32_t kCrates = 50;

// The host's threads: none. A frame of a thread that asked for it stops half-way, and so keeps its
// snapshot until it is let go.
class Turnstile {
public:
    rt_scheduler scheduler() {
        rt_scheduler scheduler{};
        scheduler.user = this;
        scheduler.run = [](void* self, uint32_t count, rt_task_function task, void* data) {
            static_cast<Turnstile*>(self)->pass();
            for (uint32_t i = 0; i < count; ++i) task(data, i);
        };
        scheduler.concurrency = 2;
        return scheduler;
    }

    // By the thread that is to stop.
    void stop_here() {
        const std::lock_guard lock(mutex_);
        stopped_ = std::this_thread::get_id();
    }
    void wait_until_stopped() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return waiting_; });
    }
    void let_go() {
        const std::lock_guard lock(mutex_);
        stopped_ = {};
        changed_.notify_all();
    }

private:
    void pass() {
        std::unique_lock lock(mutex_);
        if (stopped_ != std::this_thread::get_id()) return;
        waiting_ = true;
        changed_.notify_all();
        changed_.wait(lock, [&] { return stopped_ != std::this_thread::get_id(); });
        waiting_ = false;
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::thread::id stopped_;
    bool waiting_ = false;
};

//   a flag of 2,048 triangles that waves, and crates that go round
class MovingWorld {
public:
    MovingWorld() : world_(desc()) {
        add_flag();
        add_crates();
    }

    void move(uint32_t step) {
        wave(step);
        go_round(step);
        ASSERT_OK(rt_commit_scene(world_->scene, nullptr, nullptr));
    }

    // A frame that began before these commits and ends after them.
    void move_under_a_frame(uint32_t first, uint32_t end) {
        std::thread reader([&] {
            turnstile_.stop_here();
            EXPECT_FALSE(render(world_->scene).empty());
        });
        turnstile_.wait_until_stopped();
        for (uint32_t step = first; step < end; ++step) {
            move(step);
            EXPECT_EQ(stats().snapshots_alive, 2u) << "the current one and that of the frame";
        }
        turnstile_.let_go();
        reader.join();
    }

    void go_round(uint32_t step) {
        for (uint32_t i = 0; i < kCrates; ++i) {
            rt_transform transform = rt_default_transform();
            transform.m[3] = 20 * std::cos(0.1 * (step + i));
            transform.m[11] = 20 * std::sin(0.1 * (step + i));
            ASSERT_OK(rt_set_mesh_transform(world_->scene, crates_[i], &transform));
        }
    }

    rt_scene_stats stats() const {
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats((*world_).scene, &stats));
        EXPECT_EQ(stats.allocation_count + 1, memory_.allocations()) << "and the scene itself";
        return stats;
    }
    rt_scene scene() { return world_->scene; }

private:
    rt_scene_desc desc() {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.allocator = memory_.allocator();
        desc.scheduler = turnstile_.scheduler();
        return desc;
    }

    std::vector<float> flag_at(uint32_t step) const {
        std::vector<float> positions;
        for (uint32_t z = 0; z <= kCells; ++z)
            for (uint32_t x = 0; x <= kCells; ++x)
                positions.insert(positions.end(),
                                 {0.1f * float(x), 3 + std::sin(0.3f * float(x + z + step)),
                                  0.1f * float(z) + 0.2f * std::sin(0.7f * float(step))});
        return positions;
    }

    void add_flag() {
        std::vector<uint32_t> indices;
        for (uint32_t z = 0; z < kCells; ++z)
            for (uint32_t x = 0; x < kCells; ++x) {
                const uint32_t a = z * (kCells + 1) + x, b = a + 1, c = a + kCells + 1, d = c + 1;
                indices.insert(indices.end(), {a, b, c, b, d, c});
            }
        const std::vector<float> positions = flag_at(0);
        const std::vector<float> normals(3 * kVertices, 1.0f);
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.positions = array_of(positions, kVertices);
        desc.normals = array_of(normals, kVertices);
        desc.indices = array_of(indices, indices.size());
        ASSERT_OK(rt_add_dynamic_mesh(world_->scene, &desc, &flag_));
    }

    void add_crates() {
        const std::vector<float> positions = {-1, 0, 1, 1, 0, 1, 1, 2, -1};
        rt_mesh_desc desc = rt_default_mesh_desc();
        desc.index_type = RT_INDEX_NONE;
        desc.positions = array_of(positions, 3);
        ASSERT_OK(rt_add_rigid_mesh(world_->scene, &desc, &crates_[0]));
        for (uint32_t i = 1; i < kCrates; ++i)
            ASSERT_OK(rt_add_mesh_instance(world_->scene, crates_[0], &crates_[i]));
    }

    void wave(uint32_t step) {
        const std::vector<float> positions = flag_at(step);
        rt_mesh_update update = rt_default_mesh_update();
        update.positions = array_of(positions, kVertices);
        ASSERT_OK(rt_update_dynamic_mesh(world_->scene, flag_, &update));
    }

    TestMemory memory_;
    Turnstile turnstile_;
    WorldGuard world_;
    rt_mesh flag_{};
    rt_mesh crates_[kCrates]{};
};

void expect_nothing_allocated(const rt_scene_stats& before, const rt_scene_stats& after) {
    EXPECT_EQ(after.allocation_count, before.allocation_count);
    EXPECT_EQ(after.bytes_allocated, before.bytes_allocated);
    EXPECT_EQ(after.bytes_peak, before.bytes_peak);
}

TEST(SteadyState, CommitsAllocateNothing) {
    MovingWorld world;
    uint32_t step = 1;
    for (; step < 4; ++step) world.move(step);
    world.move_under_a_frame(step, step + 3);
    const rt_scene_stats before = world.stats();
    for (step += 3; step < 100; step += 10) {
        for (uint32_t i = 0; i < 6; ++i) world.move(step + i);
        world.move_under_a_frame(step + 6, step + 10);
    }
    expect_nothing_allocated(before, world.stats());
}

TEST(SteadyState, RigidMovesAllocateNothing) {
    MovingWorld world;
    const auto go_round = [&](uint32_t step) {
        world.go_round(step);
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(world.scene(), nullptr, &report));
        return report;
    };
    for (uint32_t step = 0; step < 4; ++step) go_round(step);
    const rt_scene_stats before = world.stats();
    for (uint32_t step = 4; step < 50; ++step) {
        const rt_commit_report report = go_round(step);
        EXPECT_EQ(report.rebuilt, 0u);
        EXPECT_EQ(report.instance_count, kCrates);
    }
    expect_nothing_allocated(before, world.stats());
}

// ... nor do lamps that move, however long; and no commit takes longer for those before it.
TEST(SteadyState, MovedLampsAllocateNothing) {
    constexpr uint32_t kLamps = 100, kCommits = 10'000;
    MovingWorld world;
    std::vector<rt_light> lamps(kLamps);
    rt_light_desc lamp = rt_default_light_desc();
    for (uint32_t i = 0; i < kLamps; ++i) {
        lamp.position[0] = i;
        ASSERT_OK(rt_add_light(world.scene(), &lamp, &lamps[i]));
    }
    const auto move = [&](uint32_t step) {
        lamp.position[0] = step % kLamps + 0.001 * step;
        EXPECT_OK(rt_update_light(world.scene(), lamps[step % kLamps], &lamp));
        rt_commit_report report = rt_default_commit_report();
        EXPECT_OK(rt_commit_scene(world.scene(), nullptr, &report));
        return report.commit_ms;
    };
    for (uint32_t step = 0; step < 4; ++step) move(step);
    const rt_scene_stats before = world.stats();
    std::vector<double> ms;
    for (uint32_t step = 4; step < kCommits; ++step) ms.push_back(move(step));
    expect_nothing_allocated(before, world.stats());
    EXPECT_EQ(world.stats().snapshots_alive, 1u);
    const auto median = [](auto begin, auto end) {
        std::nth_element(begin, begin + (end - begin) / 2, end);
        return *(begin + (end - begin) / 2);
    };
    EXPECT_LT(median(ms.end() - 1000, ms.end()), 10 * median(ms.begin(), ms.begin() + 1000));
}

// What a large mesh needed is not kept for small ones.
TEST(SteadyState, MemoryOfWhatIsGoneGoesBack) {
    MovingWorld world;
    for (uint32_t step = 0; step < 4; ++step) world.move(step);
    const uint64_t before = world.stats().bytes_allocated;
    std::vector<float> corners(9 * 60000);
    for (size_t i = 0; i < corners.size(); ++i) corners[i] = float(i * 7919 % 1009);
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.index_type = RT_INDEX_NONE;
    desc.positions = array_of(corners, 3 * 60000);
    rt_mesh mesh;
    ASSERT_OK(rt_add_dynamic_mesh(world.scene(), &desc, &mesh));
    world.move(4);
    EXPECT_GT(world.stats().bytes_allocated, before + 5'000'000);
    ASSERT_OK(rt_remove_mesh(world.scene(), mesh));
    world.move(5);
    EXPECT_LT(world.stats().bytes_allocated, before + 100'000);
}

} // namespace
} // namespace peregrine::test
