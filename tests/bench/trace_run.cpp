#include "trace_run.h"

#include "timing.h"

#include <algorithm>
#include <vector>

namespace peregrine::bench {
namespace {

constexpr size_t kShare = size_t(1) << 16; // rays

} // namespace

TraceRunner::TraceRunner(uint32_t threads) : threads_(threads), scheduler_(threads, {}, &memory_) {}

double TraceRunner::run_batches(const Tracer& tracer, size_t mode, const RaySet& set,
                                Results& results) const {
    const auto now = [&] { return threads_ == 1 ? thread_seconds() : wall_seconds(); };
    const double start = now();
    for (size_t i = 0; i + 1 < set.batches.size(); ++i)
        tracer.trace(mode, set, set.batches[i], set.batches[i + 1] - set.batches[i], results);
    return now() - start;
}

double TraceRunner::run(const Tracer& tracer, size_t mode, const RaySet& set, Results& results) {
    if (tracer.is_parallel(mode)) return run_batches(tracer, mode, set, results);
    struct Share {
        size_t first, count;
    };
    std::vector<Share> shares;
    for (size_t batch = 0; batch + 1 < set.batches.size(); ++batch) {
        const size_t last = set.batches[batch + 1];
        const size_t most = threads_ == 1 ? last : kShare;
        for (size_t first = set.batches[batch]; first < last; first += most)
            shares.push_back({first, std::min(most, last - first)});
    }
    const auto trace_share = [&](size_t i) {
        tracer.trace(mode, set, shares[i].first, shares[i].count, results);
    };
    if (threads_ == 1) {
        const double start = thread_seconds();
        for (size_t i = 0; i < shares.size(); ++i) trace_share(i);
        return thread_seconds() - start;
    }
    const double start = wall_seconds();
    scheduler_.for_each(uint32_t(shares.size()), trace_share);
    return wall_seconds() - start;
}

} // namespace peregrine::bench
