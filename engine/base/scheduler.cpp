#include "base/scheduler.h"

#include <algorithm>
#include <atomic>

namespace peregrine::base {

// Lives on the stack of the thread that called run.
struct Scheduler::Job {
    uint32_t count = 0;
    TaskFunction task = nullptr;
    void* data = nullptr;
    std::atomic<uint32_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr exception; // written by whoever set `failed`
    uint32_t helpers = 0;         // pool threads inside; guarded by the mutex
    Job* next_job = nullptr;

    void run_one(uint32_t index) noexcept {
        if (failed.load(std::memory_order_relaxed)) return;
        try {
            task(data, index);
        } catch (...) {
            if (!failed.exchange(true)) exception = std::current_exception();
        }
    }

    void run_all() noexcept {
        for (uint32_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) run_one(i);
    }

    bool exhausted() const { return next.load(std::memory_order_relaxed) >= count; }
};

Scheduler::Scheduler(uint32_t worker_count, const HostScheduler& host, Memory* memory)
    : host_(host), concurrency_(std::max(1u, host.run ? host.concurrency : worker_count)),
      threads_(memory) {
    if (host_.run) return;
    threads_.reserve(concurrency_ - 1);
    try {
        for (uint32_t i = 1; i < concurrency_; ++i)
            threads_.emplace_back([this] { work_until_stopped(); });
    } catch (...) {
        stop();
        throw;
    }
}

Scheduler::~Scheduler() {
    stop();
}

void Scheduler::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    work_available_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
}

void Scheduler::run(uint32_t count, TaskFunction task, void* data) {
    if (count == 0) return;
    Job job;
    job.count = count;
    job.task = task;
    job.data = data;
    if (host_.run)
        host_.run(
            host_.user, count,
            [](void* self, uint32_t index) { static_cast<Job*>(self)->run_one(index); }, &job);
    else if (count == 1 || threads_.empty())
        job.run_all();
    else
        run_on_pool(job);
    if (job.failed.load()) std::rethrow_exception(job.exception);
}

void Scheduler::run_on_pool(Job& job) {
    {
        const std::lock_guard lock(mutex_);
        job.next_job = jobs_;
        jobs_ = &job;
    }
    work_available_.notify_all();
    job.run_all();
    std::unique_lock lock(mutex_);
    for (Job** link = &jobs_; *link; link = &(*link)->next_job) {
        if (*link == &job) {
            *link = job.next_job;
            break;
        }
    }
    job_left_.wait(lock, [&] { return job.helpers == 0; });
}

Scheduler::Job* Scheduler::find_job() {
    for (Job* job = jobs_; job; job = job->next_job)
        if (!job->exhausted()) return job;
    return nullptr;
}

void Scheduler::work_until_stopped() {
    std::unique_lock lock(mutex_);
    for (;;) {
        Job* job = nullptr;
        work_available_.wait(lock, [&] { return stopping_ || (job = find_job()) != nullptr; });
        if (stopping_) return;
        ++job->helpers;
        lock.unlock();
        job->run_all();
        lock.lock();
        if (--job->helpers == 0) job_left_.notify_all();
    }
}

} // namespace peregrine::base
