// Queries and frames while the world moves: every answer is that of one legal snapshot, the one
// that was current when the call began. Also the target of ThreadSanitizer.
#include "support.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace peregrine::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kPoses = 8;
constexpr auto kDuration = std::chrono::milliseconds(2000);

float height_of(uint64_t step) {
    return 1.0f + 0.25f * float(step % kPoses);
}

// What the scene answers and shows in each pose, asked one after the other.
struct Legal {
    std::vector<Bytes> hits, pixels;
};

Bytes ask(rt_scene scene, const std::vector<rt_ray>& rays) {
    std::vector<rt_hit> hits(rays.size());
    rt_query_desc query = rt_default_query_desc();
    query.rays = rays.data();
    query.ray_count = rays.size();
    query.hits = hits.data();
    if (rt_trace_query(scene, &query) != RT_OK) return {};
    for (rt_hit& hit : hits) hit.mesh.generation = hit.mesh.generation != 0; // differs by scene
    Bytes bytes(hits.size() * sizeof(rt_hit));
    std::memcpy(bytes.data(), hits.data(), bytes.size());
    return bytes;
}

void go_to(const World& world, uint64_t step) {
    ASSERT_OK(move_lift(world, height_of(step)));
    ASSERT_OK(rt_commit_scene(world.scene, nullptr, nullptr));
}

Legal learn(const World& world, const std::vector<rt_ray>& rays) {
    Legal legal;
    for (uint32_t pose = 0; pose < kPoses; ++pose) {
        go_to(world, pose);
        legal.hits.push_back(ask(world.scene, rays));
        legal.pixels.push_back(render(world.scene));
    }
    return legal;
}

class Race {
public:
    Race() : world_(desc()), rays_(world_rays()), legal_(learn(*world_, rays_)) {
        go_to(*world_, 0);
    }

    void run() {
        std::vector<std::thread> threads;
        for (int i = 0; i < 3; ++i)
            threads.emplace_back(
                [this] { read([this] { return ask(scene(), rays_); }, legal_.hits); });
        threads.emplace_back([this] { read([this] { return render(scene()); }, legal_.pixels); });
        const Clock::time_point end = Clock::now() + kDuration;
        for (uint64_t step = 1; Clock::now() < end; ++step) commit(step);
        stop_ = true;
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(wrong_, 0u);
        EXPECT_GT(reads_, 50u);
        EXPECT_GT(finished_, 20u);
    }

private:
    static rt_scene_desc desc() {
        rt_scene_desc desc = rt_default_scene_desc();
        desc.worker_count = 2;
        return desc;
    }

    rt_scene scene() { return world_->scene; }

    void commit(uint64_t step) {
        begun_ = step;
        go_to(*world_, step);
        finished_ = step;
        EXPECT_EQ(ask(scene(), rays_), legal_.hits[step % kPoses]) << "stale after its own commit";
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats(scene(), &stats));
        EXPECT_LE(stats.snapshots_alive, 1 + 4u) << "the current one and one a reader";
    }

    // The answer belongs to a step between those that were finished before and begun after.
    template <class Ask>
    void read(Ask&& ask_once, const std::vector<Bytes>& legal) {
        while (!stop_) {
            const uint64_t first = finished_;
            const Bytes answer = ask_once();
            const uint64_t last = begun_;
            ++reads_;
            bool found = false;
            for (uint64_t step = first; step <= std::min(last, first + kPoses); ++step)
                found |= answer == legal[step % kPoses];
            wrong_ += !found;
        }
    }

    WorldGuard world_;
    std::vector<rt_ray> rays_;
    Legal legal_;
    std::atomic<uint64_t> begun_{0}, finished_{0}, reads_{0}, wrong_{0};
    std::atomic<bool> stop_{false};
};

TEST(Concurrency, EveryAnswerIsThatOfOneLegalSnapshot) {
    Race().run();
}

TEST(Concurrency, PosesDiffer) {
    WorldGuard world;
    const Legal legal = learn(*world, world_rays());
    for (uint32_t pose = 1; pose < kPoses; ++pose) {
        EXPECT_NE(legal.hits[pose], legal.hits[0]);
        EXPECT_NE(legal.pixels[pose], legal.pixels[0]);
    }
}

// Threads that come and go leave nothing behind that a later commit would wait for.
TEST(Concurrency, ThreadsThatEndFreeTheirSnapshots) {
    WorldGuard world;
    const std::vector<rt_ray> rays = world_rays();
    for (int round = 0; round < 20; ++round) {
        std::thread([&] { EXPECT_FALSE(ask(world->scene, rays).empty()); }).join();
        go_to(*world, uint64_t(round));
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats(world->scene, &stats));
        EXPECT_EQ(stats.snapshots_alive, 1u);
    }
}

TEST(Concurrency, ScenesComeAndGoOnManyThreads) {
    std::atomic<uint32_t> wrong{0};
    WorldGuard reference;
    const Bytes expected = answers(reference->scene);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            for (int round = 0; round < 20; ++round) {
                World world;
                wrong += make_world(world) != RT_OK;
                wrong += answers(world.scene) != expected;
                wrong += rt_destroy_scene(world.scene) != RT_OK;
                wrong += rt_destroy_scene(world.scene) != RT_ERROR_INVALID_HANDLE;
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0u);
}

TEST(LastError, IsEachThreadsOwn) {
    EXPECT_EQ(rt_destroy_scene({7, 9}), RT_ERROR_INVALID_HANDLE);
    std::thread([] {
        EXPECT_STREQ(rt_get_last_error(), "");
        EXPECT_EQ(rt_destroy_scene({8, 9}), RT_ERROR_INVALID_HANDLE);
        EXPECT_NE(std::string(rt_get_last_error()).find("{8, 9}"), std::string::npos);
    }).join();
    EXPECT_NE(std::string(rt_get_last_error()).find("{7, 9}"), std::string::npos);
}

} // namespace
} // namespace peregrine::test
