#pragma once

#include "base/scheduler.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::query {

inline constexpr uint32_t kChunk = 1024; // rays: as many as a tile of a frame

// Fewer rays than this stay on the calling thread: waking others costs tens of microseconds.
inline constexpr uint64_t kSmallestSpread = 4 * kChunk;

// Calls work(first, end) for ranges that make up [0, count), of whole chunks but for the last, on
// the scheduler's threads if there are any and it is worth it, else for all at once.
template <class Work>
void spread(base::Scheduler* scheduler, uint64_t count, Work&& work) {
    if (!scheduler || scheduler->concurrency() == 1 || count < kSmallestSpread)
        return work(uint64_t(0), count);
    const uint64_t chunks = (count + kChunk - 1) / kChunk;
    const uint64_t most = 8 * uint64_t(scheduler->concurrency()); // for those that end early
    const uint64_t range = (chunks + most - 1) / most * kChunk;
    scheduler->for_each(uint32_t((count + range - 1) / range),
                        [&](uint32_t i) { work(i * range, std::min(count, (i + 1) * range)); });
}

} // namespace peregrine::query
