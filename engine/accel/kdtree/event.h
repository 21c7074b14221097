#pragma once

#include <bit>
#include <cstdint>

namespace peregrine::accel::kdtree {

// Where the sweep plane meets or leaves the bounds of a triangle (Wald and Havran 2006, section
// 4.2), as one key whose integer order is theirs: position, then end < planar < start, then index.
//   63      32 31  30 29       0
//   | position | type |  index  |     index: into the node's own list of triangles
using Event = uint64_t;

enum EventType : uint32_t { kEnd = 0, kPlanar = 1, kStart = 2 };

inline constexpr uint32_t kIndexBits = 30;
inline constexpr uint32_t kIndexMask = (1u << kIndexBits) - 1;

// Orders as the floats do; -0 becomes +0.
inline uint32_t ordered(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value + 0.0f);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

inline Event make_event(float position, EventType type, uint32_t index) {
    return uint64_t(ordered(position)) << 32 | uint64_t(type) << kIndexBits | index;
}

inline float position(Event event) {
    const uint32_t key = uint32_t(event >> 32);
    const uint32_t negative = uint32_t(int32_t(~key) >> 31);
    return std::bit_cast<float>(key ^ (negative | 0x80000000u));
}

inline EventType type(Event event) {
    return EventType(uint32_t(event) >> kIndexBits);
}
inline uint32_t index(Event event) {
    return uint32_t(event) & kIndexMask;
}

// Writes the one or two events of a triangle that spans lower..upper; returns how many.
inline uint32_t write_events(float lower, float upper, uint32_t index, Event* out) {
    if (lower == upper) {
        out[0] = make_event(lower, kPlanar, index);
        return 1;
    }
    out[0] = make_event(lower, kStart, index);
    out[1] = make_event(upper, kEnd, index);
    return 2;
}

} // namespace peregrine::accel::kdtree
