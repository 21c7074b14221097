#pragma once

#include "trace/visitor.h"

#include <atomic>

namespace peregrine::query {

// Of all threads that take part in a query.
class TotalCounters {
public:
    void add(const trace::Counters& counters) {
        nodes_.fetch_add(counters.nodes, std::memory_order_relaxed);
        triangles_.fetch_add(counters.triangles, std::memory_order_relaxed);
        instances_.fetch_add(counters.instances, std::memory_order_relaxed);
    }
    trace::Counters get() const { return {nodes_.load(), triangles_.load(), instances_.load()}; }

private:
    std::atomic<uint64_t> nodes_{0}, triangles_{0}, instances_{0};
};

} // namespace peregrine::query
