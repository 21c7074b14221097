#pragma once

#include "accel/control.h"
#include "base/memory.h"
#include "base/scheduler.h"

#include <algorithm>
#include <cstdint>

namespace peregrine::accel {

// Builds `count` subtrees in parallel, large ones first, so that no thread is left with one at the
// end: build(i), of size(i) triangles. `done` is the part of the work that lies behind. Throws
// base::Error cancelled.
template <class Size, class Build>
void build_subtrees(uint32_t count, Size&& size, Build&& build, float done, Control& control,
                    base::Scheduler& scheduler, base::Memory* memory) {
    constexpr uint32_t kUsual = 256; // the same room for most, so that builds use it again
    base::Vector<uint32_t> order(memory);
    order.reserve(std::max(count, kUsual));
    uint64_t work = 0;
    for (uint32_t i = 0; i < count; ++i) {
        order.push_back(i);
        work += size(i);
    }
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const uint32_t size_a = size(a), size_b = size(b);
        return size_a != size_b ? size_a > size_b : a < b;
    });
    control.expect(work, done);
    scheduler.for_each(count, [&](uint32_t i) {
        if (control.cancelled()) return;
        const uint32_t triangles = size(order[i]); // building may take them away
        build(order[i]);
        control.finish(triangles);
    });
    control.throw_if_cancelled();
}

} // namespace peregrine::accel
