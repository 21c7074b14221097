// Threads: none that the host did not ask for, and no pixel that depends on them.
#include "support.h"

#include <dirent.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

namespace peregrine::test {
namespace {

unsigned thread_count() {
    DIR* directory = opendir("/proc/self/task");
    unsigned count = 0;
    while (const dirent* entry = readdir(directory)) count += entry->d_name[0] != '.';
    closedir(directory);
    return count;
}

// ... of a process that had a thread before: a sanitizer starts one of its own with the first.
unsigned first_thread_count() {
    std::thread([] {}).join();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return thread_count();
}

// A thread that was joined may be listed a moment longer.
void expect_threads(unsigned expected) {
    for (int i = 0; i < 200 && thread_count() != expected; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(thread_count(), expected);
}

rt_scene_desc with_workers(uint32_t count) {
    rt_scene_desc desc = rt_default_scene_desc();
    desc.worker_count = count;
    return desc;
}

// What must not depend on threads: the tree's report, the answers, the pixels.
struct Outcome {
    rt_commit_report report = rt_default_commit_report();
    Bytes answers, pixels;

    explicit Outcome(const rt_scene_desc& desc) {
        World world;
        EXPECT_OK(rt_create_scene(&desc, &world.scene));
        EXPECT_OK(describe_world(world));
        EXPECT_OK(rt_commit_scene(world.scene, nullptr, &report));
        report.build_ms = report.dynamic_build_ms = report.commit_ms = 0;
        answers = test::answers(world.scene);
        pixels = render(world.scene, 130, 70);
        EXPECT_FALSE(pixels.empty());
        EXPECT_OK(rt_destroy_scene(world.scene));
    }
    friend bool operator==(const Outcome& a, const Outcome& b) {
        return std::memcmp(&a.report, &b.report, sizeof a.report) == 0 && a.answers == b.answers
               && a.pixels == b.pixels;
    }
};

TEST(Threads, NoneWithoutWorkers) {
    const unsigned before = first_thread_count();
    for (const uint32_t workers : {0u, 1u}) {
        WorldGuard world(with_workers(workers));
        EXPECT_FALSE(render(world->scene).empty());
        EXPECT_EQ(thread_count(), before);
    }
}

TEST(Threads, AsManyAsAskedForAndJoinedInTheEnd) {
    const unsigned before = first_thread_count();
    {
        WorldGuard world(with_workers(4));
        expect_threads(before + 3);
        EXPECT_FALSE(render(world->scene).empty());
        EXPECT_EQ(thread_count(), before + 3);
        rt_scene_stats stats = rt_default_scene_stats();
        EXPECT_OK(rt_get_scene_stats(world->scene, &stats));
        EXPECT_EQ(stats.threads, 4u);
    }
    expect_threads(before);
}

TEST(Threads, SleepBetweenFrames) {
    WorldGuard world(with_workers(4));
    EXPECT_FALSE(render(world->scene).empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(50)); // they fall asleep
    const auto cpu_ms = [] { return 1e3 * double(std::clock()) / CLOCKS_PER_SEC; };
    const double before = cpu_ms();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_LT(cpu_ms() - before, 30) << "three spinning threads would use 300 to 900 ms";
}

void run_sequentially(void*, uint32_t count, rt_task_function task, void* data) {
    for (uint32_t i = 0; i < count; ++i) task(data, i);
}

void run_reversed(void*, uint32_t count, rt_task_function task, void* data) {
    for (uint32_t i = count; i-- > 0;) task(data, i);
}

void run_on_threads(void* user, uint32_t count, rt_task_function task, void* data) {
    static_cast<std::atomic<uint32_t>*>(user)->fetch_add(count);
    std::atomic<uint32_t> next{0};
    const auto work = [&] {
        for (uint32_t i; (i = next.fetch_add(1)) < count;) task(data, i);
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
}

TEST(Scheduler, EveryoneGivesTheSameTreeAnswersAndPixels) {
    const Outcome expected(with_workers(1));
    for (const uint32_t workers : {2u, 3u, 8u, 33u})
        EXPECT_TRUE(Outcome(with_workers(workers)) == expected) << workers;
    for (const auto run : {run_sequentially, run_reversed})
        for (const uint32_t concurrency : {1u, 2u, 7u}) {
            rt_scene_desc desc = rt_default_scene_desc();
            desc.scheduler = {nullptr, run, concurrency, 0};
            EXPECT_TRUE(Outcome(desc) == expected) << concurrency;
        }
    std::atomic<uint32_t> tasks{0};
    rt_scene_desc desc = with_workers(300); // ignored
    desc.scheduler = {&tasks, run_on_threads, 3, 0};
    EXPECT_TRUE(Outcome(desc) == expected);
    EXPECT_GT(tasks, 3u);
}

TEST(Scheduler, HostThreadsMeanNoneOfOurs) {
    const unsigned before = first_thread_count();
    rt_scene_desc desc = with_workers(8);
    desc.scheduler = {nullptr, run_sequentially, 8, 0};
    WorldGuard world(desc);
    EXPECT_EQ(thread_count(), before);
    rt_frame_stats stats = rt_default_frame_stats();
    uint32_t pixel;
    const rt_camera camera = world_camera();
    rt_frame_desc frame = rt_default_frame_desc();
    frame.pixels = &pixel;
    frame.width = frame.height = 1;
    EXPECT_OK(rt_render_frame(world->scene, &camera, &frame, &stats));
    EXPECT_EQ(stats.threads, 8u);
}

// A scheduler that throws is a host's mistake that must not become a crash.
TEST(Scheduler, ExceptionOfTheHostIsReported) {
    bool throws = false;
    rt_scene_desc desc = rt_default_scene_desc();
    desc.scheduler = {&throws,
                      [](void* user, uint32_t count, rt_task_function task, void* data) {
                          if (*static_cast<bool*>(user)) throw 42;
                          run_sequentially(nullptr, count, task, data);
                      },
                      1, 0};
    WorldGuard world(desc);
    const Bytes before = answers(world->scene);
    throws = true;
    EXPECT_TRUE(render(world->scene).empty());
    EXPECT_NE(std::string(rt_get_last_error()).find("callback"), std::string::npos);
    throws = false;
    EXPECT_EQ(answers(world->scene), before);
    EXPECT_FALSE(render(world->scene).empty());
}

TEST(Log, OneLineACommitAndAWarningForDroppedTriangles) {
    std::vector<std::pair<rt_log_level, std::string>> lines;
    rt_scene_desc desc = rt_default_scene_desc();
    desc.log_user = &lines;
    desc.log = [](void* user, rt_log_level level, const char* message) {
        static_cast<decltype(lines)*>(user)->emplace_back(level, message);
        throw 1; // which the library survives
    };
    WorldGuard world(desc);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].first, RT_LOG_INFO);
    EXPECT_NE(lines[0].second.find("130 triangles"), std::string::npos) << lines[0].second;
    std::vector<float> line(12, 0.0f); // the lift becomes two triangles without area
    rt_mesh_update update = rt_default_mesh_update();
    update.positions = array_of(line, 4);
    ASSERT_OK(rt_update_dynamic_mesh(world->scene, world->lift, &update));
    ASSERT_OK(rt_commit_scene(world->scene, nullptr, nullptr));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[2].first, RT_LOG_WARNING);
    EXPECT_NE(lines[2].second.find("2 triangles without area"), std::string::npos);
}

} // namespace
} // namespace peregrine::test
