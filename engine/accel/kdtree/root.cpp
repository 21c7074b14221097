#include "accel/kdtree/root.h"

#include <algorithm>
#include <utility>

namespace peregrine::accel::kdtree {
namespace {

constexpr uint32_t kPasses = 3;
constexpr uint32_t kShift[kPasses] = {kIndexBits, kIndexBits + 12, kIndexBits + 23};
constexpr uint32_t kBits[kPasses] = {12, 11, 11};
constexpr uint32_t kMaxBuckets = 1u << 12;

// By position and type; stable, so that events that were made in order of index are in order.
// Returns which of the two arrays holds the result.
Event* radix_sort(Event* events, Event* spare, uint32_t count, uint32_t* buckets) {
    for (uint32_t pass = 0; pass < kPasses; ++pass) {
        const uint32_t shift = kShift[pass];
        const uint32_t mask = (1u << kBits[pass]) - 1;
        std::fill_n(buckets, kMaxBuckets, 0u);
        for (uint32_t i = 0; i < count; ++i) ++buckets[uint32_t(events[i] >> shift) & mask];
        uint32_t sum = 0;
        for (uint32_t b = 0; b <= mask; ++b) sum += std::exchange(buckets[b], sum);
        for (uint32_t i = 0; i < count; ++i)
            spare[buckets[uint32_t(events[i] >> shift) & mask]++] = events[i];
        std::swap(events, spare);
    }
    return events;
}

uint32_t write_axis(std::span<const geometry::Triangle> triangles, int axis, Event* out,
                    math::Box& bounds) {
    uint32_t count = 0;
    float least = bounds.lower[axis];
    float most = bounds.upper[axis];
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const geometry::Triangle& t = triangles[i];
        const auto [low, high] = std::minmax({t.v0[axis], t.v1[axis], t.v2[axis]});
        count += write_events(low, high, i, out + count);
        least = std::min(least, low);
        most = std::max(most, high);
    }
    bounds.lower[axis] = least + 0.0f; // -0 becomes +0
    bounds.upper[axis] = most + 0.0f;
    return count;
}

} // namespace

void make_root(std::span<const geometry::Triangle> triangles, base::Scheduler& scheduler,
               base::Memory* memory, OwnedLists& lists, math::Box& bounds) {
    lists.triangles = uint32_t(triangles.size());
    lists.ids.allocate(triangles.size());
    for (uint32_t i = 0; i < lists.triangles; ++i) lists.ids[i] = i;
    scheduler.for_each(3, [&](uint32_t axis) {
        Buffer<Event> spare(memory);
        Buffer<uint32_t> buckets(memory);
        Buffer<Event>& events = lists.events[axis];
        events.allocate(2 * triangles.size());
        spare.allocate(2 * triangles.size());
        buckets.allocate(kMaxBuckets);
        const uint32_t count = write_axis(triangles, int(axis), events.data(), bounds);
        lists.count[axis] = count;
        if (radix_sort(events.data(), spare.data(), count, buckets.data()) != events.data())
            events = std::move(spare);
    });
}

} // namespace peregrine::accel::kdtree
