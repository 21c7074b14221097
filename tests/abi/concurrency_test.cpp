// Queries and frames while the world moves, in as many commits as go: every answer is that of one
// legal snapshot, the one that was current when the call began, and old ones do not pile up. Also
// the target of ThreadSanitizer. $PEREGRINE_STRESS_SECONDS makes it longer.
#include "support.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace peregrine::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kPoses = 8;
constexpr uint32_t kCrates = 20;
constexpr uint64_t kWarmUp = 50; // commits

std::chrono::duration<double> duration() {
    const char* const seconds = std::getenv("PEREGRINE_STRESS_SECONDS");
    return std::chrono::duration<double>(seconds ? std::atof(seconds) : 2);
}

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

// Kernels of SIMD are not instrumented (engine/CMakeLists.txt).
rt_scene_desc seen_by_sanitizers() {
    rt_scene_desc desc = rt_default_scene_desc();
#if defined(__SANITIZE_THREAD__)
    desc.isa = RT_ISA_SCALAR;
#endif
    return desc;
}

// A lift that deforms, and crates that move as a whole.
class Yard {
public:
    explicit Yard(const rt_scene_desc& desc = seen_by_sanitizers()) : world_(desc) {
        const std::vector<float> corners = {-0.4f, 0, 0.4f, 0.4f, 0, 0.4f, 0, 0.5f, -0.4f};
        rt_mesh_desc mesh = rt_default_mesh_desc();
        mesh.index_type = RT_INDEX_NONE;
        mesh.positions = array_of(corners, 3);
        EXPECT_OK(rt_add_rigid_mesh(scene(), &mesh, &crates_[0]));
        for (uint32_t i = 1; i < kCrates; ++i)
            EXPECT_OK(rt_add_mesh_instance(scene(), crates_[0], &crates_[i]));
    }

    rt_scene scene() { return world_->scene; }

    void go_to(uint64_t step) {
        for (uint32_t i = 0; i < kCrates; ++i) {
            rt_transform transform = rt_default_transform();
            transform.m[3] = double(i % 5) - 2;
            transform.m[7] = 0.2 * double((step + i) % kPoses);
            transform.m[11] = double(i / 5) - 2;
            ASSERT_OK(rt_set_mesh_transform(scene(), crates_[i], &transform));
        }
        test::go_to(*world_, step);
    }

    Legal learn(const std::vector<rt_ray>& rays) {
        Legal legal;
        for (uint32_t pose = 0; pose < kPoses; ++pose) {
            go_to(pose);
            legal.hits.push_back(ask(scene(), rays));
            legal.pixels.push_back(render(scene()));
        }
        return legal;
    }

private:
    WorldGuard world_;
    rt_mesh crates_[kCrates]{};
};

class Race {
public:
    Race() : yard_(desc()), rays_(world_rays()), legal_(yard_.learn(rays_)) { yard_.go_to(0); }

    void run() {
        std::vector<std::thread> threads;
        for (int i = 0; i < 3; ++i)
            threads.emplace_back([this] { read([this] { return ask_timed(); }, legal_.hits); });
        threads.emplace_back([this] { read([this] { return render(scene()); }, legal_.pixels); });
        const Clock::time_point begin = Clock::now();
        for (uint64_t step = 1; Clock::now() - begin < duration(); ++step) commit(step);
        stop_ = true;
        for (std::thread& thread : threads) thread.join();
        std::printf("%.0f commits a second, %llu queries and frames, the slowest query %.2f ms\n",
                    double(finished_) / duration().count(), static_cast<unsigned long long>(reads_),
                    1e3 * slowest_query_);
        EXPECT_EQ(wrong_, 0u);
        EXPECT_GT(reads_, 50u);
        EXPECT_GT(finished_, 20u);
    }

private:
    static rt_scene_desc desc() {
        rt_scene_desc desc = seen_by_sanitizers();
        desc.worker_count = 2;
        return desc;
    }

    rt_scene scene() { return yard_.scene(); }

    void commit(uint64_t step) {
        begun_ = step;
        yard_.go_to(step);
        finished_ = step;
        EXPECT_EQ(ask(scene(), rays_), legal_.hits[step % kPoses]) << "stale after its own commit";
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats(scene(), &stats));
        EXPECT_LE(stats.snapshots_alive, 1 + 4u) << "the current one and one a reader";
        if (step == kWarmUp) bytes_ = stats.bytes_peak;
        EXPECT_LE(stats.bytes_peak, step > kWarmUp ? 3 * bytes_ : ~uint64_t(0))
            << "more than the readers can hold";
    }

    Bytes ask_timed() {
        const Clock::time_point begin = Clock::now();
        Bytes answer = ask(scene(), rays_);
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        double slowest = slowest_query_;
        while (slowest < seconds && !slowest_query_.compare_exchange_weak(slowest, seconds)) {
        }
        return answer;
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

    Yard yard_;
    std::vector<rt_ray> rays_;
    Legal legal_;
    uint64_t bytes_ = 0;
    std::atomic<double> slowest_query_{0};
    std::atomic<uint64_t> begun_{0}, finished_{0}, reads_{0}, wrong_{0};
    std::atomic<bool> stop_{false};
};

TEST(Concurrency, EveryAnswerIsThatOfOneLegalSnapshot) {
    Race().run();
}

TEST(Concurrency, PosesDiffer) {
    const Legal legal = Yard().learn(world_rays());
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
