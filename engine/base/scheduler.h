#pragma once

#include "base/memory.h"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>

namespace peregrine::base {

using TaskFunction = void (*)(void* data, uint32_t index);

// The host's threads, if it gave any.
struct HostScheduler {
    void* user = nullptr;
    void (*run)(void* user, uint32_t count, TaskFunction task, void* data) = nullptr;
    uint32_t concurrency = 1;
};

// Runs independent tasks on the host's scheduler or on worker_count - 1 threads of its own plus the
// calling one. The threads sleep on a condition variable between calls. No task waits for another.
class Scheduler {
public:
    Scheduler(uint32_t worker_count, const HostScheduler& host, Memory* memory);
    ~Scheduler();
    Scheduler(const Scheduler&) = delete;
    Scheduler& operator=(const Scheduler&) = delete;

    uint32_t concurrency() const { return concurrency_; }

    // Calls task(i) for every i < count, in any order. The first exception of a task is thrown here
    // after all have ended; tasks not yet begun are skipped then.
    template <class Task>
    void for_each(uint32_t count, Task&& task) {
        using Type = std::remove_reference_t<Task>;
        run(
            count, [](void* data, uint32_t index) { (*static_cast<Type*>(data))(index); },
            const_cast<void*>(static_cast<const void*>(&task)));
    }

private:
    struct Job;

    void run(uint32_t count, TaskFunction task, void* data);
    void run_on_pool(Job& job);
    void work_until_stopped();
    void stop();
    Job* find_job();

    HostScheduler host_;
    uint32_t concurrency_;
    std::mutex mutex_;
    std::condition_variable work_available_;
    std::condition_variable job_left_;
    Job* jobs_ = nullptr; // with tasks to hand out
    bool stopping_ = false;
    Vector<std::thread> threads_;
};

} // namespace peregrine::base
