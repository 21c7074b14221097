#pragma once

#include "accel/buffer.h"
#include "accel/kdtree/event.h"
#include "base/memory.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace peregrine::accel::kdtree {

// The triangles of a node: sorted events on three axes, which know them by their place in `ids`.
struct Lists {
    Event* events[3];
    uint32_t count[3];
    uint32_t* ids;
    uint32_t triangles;
};

struct OwnedLists {
    explicit OwnedLists(base::Memory* memory)
        : events{Buffer<Event>(memory), Buffer<Event>(memory), Buffer<Event>(memory)}, ids(memory) {
    }

    Lists view() {
        return {{events[0].data(), events[1].data(), events[2].data()},
                {count[0], count[1], count[2]},
                ids.data(),
                triangles};
    }

    std::span<const Event> events_of(uint32_t axis) const {
        return {events[axis].data(), count[axis]};
    }

    void resize(const Lists& lists) {
        std::copy_n(lists.count, 3, count);
        triangles = lists.triangles;
    }

    Buffer<Event> events[3];
    uint32_t count[3] = {0, 0, 0};
    Buffer<uint32_t> ids;
    uint32_t triangles = 0;
};

} // namespace peregrine::accel::kdtree
