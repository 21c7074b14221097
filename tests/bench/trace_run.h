#pragma once

#include "base/memory.h"
#include "base/scheduler.h"
#include "tracer.h"

#include <cstdint>

namespace peregrine::bench {

// Runs contestants over ray sets and takes the time.
class TraceRunner {
public:
    explicit TraceRunner(uint32_t threads);

    // Seconds for the whole set. One thread: its CPU time, a call per batch. More: wall time, and
    // batches are cut into runs of at most 65536 rays, unless the contestant does that itself.
    double run(const Tracer& tracer, size_t mode, const RaySet& set, Results& results);

private:
    double run_batches(const Tracer& tracer, size_t mode, const RaySet& set,
                       Results& results) const;

    uint32_t threads_;
    base::HostMemory memory_{{}};
    base::Scheduler scheduler_;
};

} // namespace peregrine::bench
