#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace peregrine::trace {

// A triangle that a ray hits, in the world's terms.
struct WorldHit {
    float t, u, v;
    uint32_t mesh;      // slot
    uint32_t primitive; // the host's own index in that mesh
    bool back_face;
};

// The order of all answers: the smaller t, then fronts before backs, then the smaller (mesh,
// primitive).
inline bool goes_before(const WorldHit& a, const WorldHit& b) {
    if (a.t != b.t) return a.t < b.t;
    if (a.back_face != b.back_face) return b.back_face;
    return a.mesh < b.mesh || (a.mesh == b.mesh && a.primitive < b.primitive);
}

// The first hits of a ray, in order, as many as there is room for; each triangle once, however
// often it comes. What is left over once it is full can be had by going on behind its last.
class HitList {
public:
    static constexpr uint32_t kRoom = 64;

    explicit HitList(uint32_t capacity) : capacity_(std::min(capacity, kRoom)) {}

    bool full() const { return count_ == capacity_; }
    std::span<const WorldHit> hits() const { return {hits_, count_}; }

    // Up to which t there may be more to take in.
    float limit() const { return full() ? hits_[count_ - 1].t : kInfinity; }

    bool wants(const WorldHit& hit) const {
        if (goes_on_ && !goes_before(behind_, hit)) return false;
        if (full() && !goes_before(hit, hits_[count_ - 1])) return false;
        const WorldHit* const place = place_of(hit);
        return place == hits_ + count_ || goes_before(hit, *place); // else it is there
    }

    // One that it wants.
    void insert(const WorldHit& hit) {
        WorldHit* const place = hits_ + (place_of(hit) - hits_);
        count_ = std::min(count_ + 1, capacity_);
        std::copy_backward(place, hits_ + count_ - 1, hits_ + count_);
        *place = hit;
    }

    // Forgets its hits; from now on those behind its last are wanted, up to `capacity`.
    void go_on(uint32_t capacity) {
        behind_ = hits_[count_ - 1];
        goes_on_ = true;
        count_ = 0;
        capacity_ = std::min(capacity, kRoom);
    }

private:
    static constexpr float kInfinity = std::numeric_limits<float>::infinity();

    // Rays meet triangles roughly from near to far: from the end.
    const WorldHit* place_of(const WorldHit& hit) const {
        const WorldHit* place = hits_ + count_;
        while (place != hits_ && !goes_before(place[-1], hit)) --place;
        return place;
    }

    uint32_t capacity_;
    uint32_t count_ = 0;
    bool goes_on_ = false;
    WorldHit behind_;
    WorldHit hits_[kRoom];
};

} // namespace peregrine::trace
