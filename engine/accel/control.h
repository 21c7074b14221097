#pragma once

#include "base/error.h"
#include "base/progress.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>

namespace peregrine::accel {

// Reports progress from the thread that called build and spreads the word if it is to stop.
class Control {
public:
    explicit Control(const base::Progress& progress)
        : progress_(progress), caller_(std::this_thread::get_id()) {}

    void expect(uint64_t work, float from_fraction) {
        total_ = work;
        base_ = from_fraction;
    }
    void finish(uint64_t work) { done_.fetch_add(work, std::memory_order_relaxed); }

    // From any thread.
    bool cancelled() {
        if (cancelled_.load(std::memory_order_relaxed)) return true;
        if (std::this_thread::get_id() != caller_) return false;
        const double done = double(done_.load(std::memory_order_relaxed));
        return report(base_ + (1 - base_) * float(done / double(std::max<uint64_t>(1, total_))));
    }

    // From the caller's thread.
    bool report(float fraction) {
        if (progress_.cancels(fraction)) cancelled_.store(true, std::memory_order_relaxed);
        return cancelled_.load(std::memory_order_relaxed);
    }

    void throw_if_cancelled() const {
        if (cancelled_.load(std::memory_order_relaxed))
            base::fail(base::Code::cancelled, "the commit was cancelled by its progress callback");
    }

private:
    const base::Progress& progress_;
    std::thread::id caller_;
    uint64_t total_ = 0;
    float base_ = 0;
    std::atomic<uint64_t> done_{0};
    std::atomic<bool> cancelled_{false};
};

} // namespace peregrine::accel
