#pragma once

#include "accel/kdtree/lists.h"
#include "accel/kdtree/sweep.h"
#include "geometry/clip.h"
#include "geometry/triangle.h"

#include <cstdint>

namespace peregrine::accel::kdtree {

// Splits a node's lists (Wald and Havran 2006, sections 4.2.1 to 4.2.3): triangles of one side keep
// their order, straddlers are clipped and merged in. One child takes the parent's place, where
// its lists always fit; the other moves to memory of the caller's. Steps in order; calls of one
// step may run at the same time.
class Partition {
public:
    explicit Partition(base::Memory* memory)
        : map_(memory), straddling_events_(memory), straddlers_(memory), bounds_(memory),
          halves_(memory), fresh_(memory), fresh_index_(memory) {}

    // What `moved` needs room for, with the slot beyond the end that branchless code writes to.
    static uint32_t events_to_move(const Split& split, const Lists& parent, uint32_t axis,
                                   bool left_moves);
    static uint32_t ids_to_move(const Split& split, bool left_moves) {
        return (left_moves ? split.left : split.right) + 1;
    }

    // Allocates. `lists` turns from the parent's into those of the child that stays.
    void begin(const geometry::Triangle* triangles, const math::Box& cell, const Split& split,
               bool left_moves, const Lists& lists, const Lists& moved);
    void classify();
    void separate(uint32_t axis);
    uint32_t straddlers() const { return straddler_count_; }
    void clip(uint32_t first, uint32_t last); // straddlers
    void place_straddlers();
    void merge(uint32_t axis, bool into_moved);

    const Lists& stayed() const { return stays_; }
    const Lists& moved() const { return moves_; }

private:
    // In the upper bits of map_, above the new index.
    enum Side : uint32_t { kStays = 0, kMoves = 1, kStraddles = 2 };

    struct FreshIndex {
        uint32_t in[2]; // the child that stays, that moves; kDropped
    };
    static constexpr uint32_t kDropped = ~0u;

    Event* straddling_events(uint32_t axis) {
        return straddling_events_.data() + size_t(axis) * (2 * size_t(straddler_count_) + 1);
    }
    const math::Box& half(uint32_t straddler, bool moved) const {
        const geometry::ClippedHalves& halves = halves_[straddler];
        return moved == left_moves_ ? halves.below : halves.above;
    }
    void record_bounds(uint32_t axis, const Event* events, uint32_t count);

    const geometry::Triangle* triangles_ = nullptr;
    math::Box cell_;
    Split split_;
    bool left_moves_ = false;
    uint32_t straddler_count_ = 0;
    Lists stays_{};
    Lists moves_{};

    Buffer<uint32_t> map_; // of the parent's indices
    Buffer<Event> straddling_events_;
    Buffer<uint32_t> straddlers_; // ids
    Buffer<math::Box> bounds_;    // of straddlers in the parent's cell
    Buffer<geometry::ClippedHalves> halves_;
    Buffer<Event> fresh_; // six lists
    Buffer<FreshIndex> fresh_index_;
};

} // namespace peregrine::accel::kdtree
