#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <vector>

namespace peregrine::bench {

inline double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

// CPU time of the calling thread, or of the whole process: what a shared machine cannot stretch.
inline double cpu_seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}
inline double thread_seconds() {
    return cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
}
inline double process_seconds() {
    return cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// The clock that the processor runs at just now, in GHz: a chain of dependent additions does one a
// cycle. Takes about 10 ms.
inline double measure_ghz() {
    constexpr uint64_t kAdditions = 20'000'000;
    const double start = thread_seconds();
    uint64_t x = 0;
    for (uint64_t i = 0; i < kAdditions; i += 10) {
        for (int k = 0; k < 10; ++k) asm volatile("add $1, %0" : "+r"(x));
    }
    return double(kAdditions) / (thread_seconds() - start) * 1e-9;
}

} // namespace peregrine::bench
