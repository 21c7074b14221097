#include "accel/kdtree/partition.h"

#include <algorithm>

namespace peregrine::accel::kdtree {

uint32_t Partition::events_to_move(const Split& split, const Lists& parent, uint32_t axis,
                                   bool left_moves) {
    return std::min(parent.count[axis], 2 * (left_moves ? split.left : split.right)) + 1;
}

void Partition::begin(const geometry::Triangle* triangles, const math::Box& cell,
                      const Split& split, bool left_moves, const Lists& lists, const Lists& moved) {
    triangles_ = triangles;
    cell_ = cell;
    split_ = split;
    left_moves_ = left_moves;
    straddler_count_ = split.left + split.right - lists.triangles;
    stays_ = lists;
    moves_ = moved;
    map_.grow(lists.triangles, 0);
    straddling_events_.grow(3 * (2 * size_t(straddler_count_) + 1), 0);
    straddlers_.grow(straddler_count_ + 1, 0);
    bounds_.grow(straddler_count_, 0);
    halves_.grow(straddler_count_, 0);
    fresh_.grow(12 * size_t(straddler_count_), 0);
    fresh_index_.grow(straddler_count_, 0);
}

// Section 4.2.1. A triangle's start precedes its end, so that the last to write is right.
void Partition::classify() {
    const Event* events = stays_.events[split_.axis];
    const uint32_t count = stays_.count[split_.axis];
    uint32_t* map = map_.data();
    const uint32_t left = left_moves_ ? kMoves : kStays;
    const uint32_t right = left_moves_ ? kStays : kMoves;
    for (uint32_t i = 0; i < split_.boundary; ++i)
        map[index(events[i])] = type(events[i]) == kStart ? uint32_t(kStraddles) : left;
    for (uint32_t i = split_.boundary; i < count; ++i) {
        uint32_t& side = map[index(events[i])];
        side = type(events[i]) == kEnd ? side : right;
    }

    uint32_t* ids = stays_.ids;
    uint32_t* moved_ids = moves_.ids;
    uint32_t* straddlers = straddlers_.data();
    uint32_t staying = 0, moving = 0, straddling = 0;
    for (uint32_t i = 0; i < stays_.triangles; ++i) {
        const uint32_t side = map[i];
        const uint32_t id = ids[i];
        const uint32_t place = side == kStays ? staying : side == kMoves ? moving : straddling;
        map[i] = side << kIndexBits | place;
        ids[staying] = id;
        moved_ids[moving] = id;
        straddlers[straddling] = id;
        staying += side == kStays;
        moving += side == kMoves;
        straddling += side == kStraddles;
    }
    stays_.triangles = staying;
    moves_.triangles = moving;
}

// Section 4.2.2, without branches: three writes, of which one is kept.
void Partition::separate(uint32_t axis) {
    const uint32_t* map = map_.data();
    Event* stay = stays_.events[axis];
    Event* move = moves_.events[axis];
    Event* straddle = straddling_events(axis);
    const Event* end = stay + stays_.count[axis];
    for (const Event* at = stay; at != end; ++at) {
        const Event event = *at;
        const uint32_t entry = map[index(event)];
        const uint32_t side = entry >> kIndexBits;
        const Event renamed = (event & ~Event(kIndexMask)) | (entry & kIndexMask);
        *stay = renamed;
        *move = renamed;
        *straddle = renamed;
        stay += side == kStays;
        move += side == kMoves;
        straddle += side == kStraddles;
    }
    stays_.count[axis] = uint32_t(stay - stays_.events[axis]);
    moves_.count[axis] = uint32_t(move - moves_.events[axis]);
    const Event* straddling = straddling_events(axis);
    record_bounds(axis, straddling, uint32_t(straddle - straddling));
}

void Partition::record_bounds(uint32_t axis, const Event* events, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        math::Box& bounds = bounds_[index(events[i])];
        const float at = position(events[i]);
        if (type(events[i]) != kEnd) bounds.lower[int(axis)] = at;
        if (type(events[i]) != kStart) bounds.upper[int(axis)] = at;
    }
}

void Partition::clip(uint32_t first, uint32_t last) {
    for (uint32_t i = first; i < last; ++i)
        halves_[i] = geometry::clip_to_halves(triangles_[straddlers_[i]], cell_, split_.axis,
                                              split_.position, bounds_[i]);
}

void Partition::place_straddlers() {
    Lists* children[2] = {&stays_, &moves_};
    for (uint32_t i = 0; i < straddler_count_; ++i) {
        for (uint32_t moved = 0; moved < 2; ++moved) {
            uint32_t& place = fresh_index_[i].in[moved];
            place = kDropped;
            if (half(i, moved).empty()) continue;
            place = children[moved]->triangles++;
            children[moved]->ids[place] = straddlers_[i];
        }
    }
}

// Section 4.2.3.
void Partition::merge(uint32_t axis, bool into_moved) {
    Event* fresh = fresh_.data() + (2 * size_t(axis) + into_moved) * 2 * straddler_count_;
    uint32_t added = 0;
    for (uint32_t i = 0; i < straddler_count_; ++i) {
        const uint32_t place = fresh_index_[i].in[into_moved];
        if (place == kDropped) continue;
        const math::Box& box = half(i, into_moved);
        added += write_events(box.lower[int(axis)], box.upper[int(axis)], place, fresh + added);
    }
    std::sort(fresh, fresh + added);

    Lists& child = into_moved ? moves_ : stays_;
    Event* old_end = child.events[axis] + child.count[axis];
    child.count[axis] += added;
    Event* out = child.events[axis] + child.count[axis];
    const Event* from = fresh + added;
    while (from != fresh) {
        const bool take_old = old_end != child.events[axis] && old_end[-1] > from[-1];
        *--out = take_old ? *--old_end : *--from;
    }
}

} // namespace peregrine::accel::kdtree
