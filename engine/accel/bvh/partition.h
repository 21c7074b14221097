#pragma once

#include "accel/buffer.h"
#include "accel/bvh/object_split.h"
#include "accel/bvh/spatial_split.h"
#include "accel/bvh/task.h"

#include <span>

namespace peregrine::accel::bvh {

// Two halves: a node's references move from one to the other when it is split.
class Arena {
public:
    explicit Arena(base::Memory* memory) : references_(memory) {}

    void allocate(uint32_t capacity) {
        references_.allocate(2 * size_t(capacity));
        capacity_ = capacity;
    }

    uint32_t capacity() const { return capacity_; }
    Reference* data() { return references_.data(); }
    const Reference* data() const { return references_.data(); }

private:
    uint32_t capacity_ = 0;
    Buffer<Reference> references_;
};

// A node yet to be built over references [begin, end) of the arena. Its slots, from slots_begin to
// slots_end, have room for more, as spatial splits make them.
struct Range {
    uint32_t begin;
    uint32_t end;
    uint32_t slots_begin;
    uint32_t slots_end;
    uint32_t depth; // of binary nodes
    Extent extent;

    uint32_t size() const { return end - begin; }
    uint32_t spare() const { return slots_end - slots_begin - size(); }
};

// The children's references go to the slots' other half, from both ends. Each child has some.
void partition(Arena& arena, const Range& range, const Split& split, uint32_t bins, Range& left,
               Range& right);

// False, and nothing done, if a side would have none or as many as there were.
bool partition(const geometry::Triangle* triangles, Arena& arena, const Range& range,
               const SpatialSplit& split, Range& left, Range& right);

// Halves of equally many, whatever it costs: for triangles that no plane separates, and for trees
// that have grown deep.
void halve(Arena& arena, const Range& range, Range& left, Range& right);

} // namespace peregrine::accel::bvh
