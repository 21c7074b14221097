#include "accel/bvh/partition.h"

#include "accel/bvh/cut.h"

#include <algorithm>

namespace peregrine::accel::bvh {
namespace {

// Where children's references go, from both ends.
class Target {
public:
    Target(Arena& arena, const Range& range)
        : data_(arena.data()), capacity_(arena.capacity()),
          begin_(range.slots_begin + (range.begin < capacity_ ? capacity_ : 0)),
          end_(range.slots_end + (range.begin < capacity_ ? capacity_ : 0)), left_(data_ + begin_),
          right_(data_ + end_) {}

    // Without a branch on the side. There must be room for one more.
    void add(const Reference& reference, bool to_left) {
        *left_ = reference;
        *(right_ - 1) = reference;
        left_ += to_left;
        right_ -= !to_left;
    }
    uint32_t room() const { return uint32_t(right_ - left_); }
    uint32_t lefts() const { return uint32_t(left_ - data_) - begin_; }
    uint32_t rights() const { return end_ - uint32_t(right_ - data_); }

    // Shares spare slots out in proportion.
    void finish(const Range& range, Range& left, Range& right) const {
        const uint32_t spare_left =
            uint32_t(uint64_t(room()) * lefts() / std::max(1u, lefts() + rights()));
        left.begin = begin_;
        left.end = begin_ + lefts();
        right.begin = end_ - rights();
        right.end = end_;
        left.slots_begin = range.slots_begin;
        left.slots_end = right.slots_begin = range.slots_begin + lefts() + spare_left;
        right.slots_end = range.slots_end;
        left.depth = right.depth = range.depth + 1;
    }

private:
    Reference* data_;
    uint32_t capacity_;
    uint32_t begin_;
    uint32_t end_;
    Reference* left_;
    Reference* right_;
};

std::span<const Reference> references_of(const Arena& arena, const Range& range) {
    return {arena.data() + range.begin, range.size()};
}

void find_extents(const Arena& arena, Range& left, Range& right) {
    left.extent = extent_of(references_of(arena, left));
    right.extent = extent_of(references_of(arena, right));
}

} // namespace

void partition(Arena& arena, const Range& range, const Split& split, uint32_t bins, Range& left,
               Range& right) {
    const BinMapping mapping(range.extent.centers, bins);
    Target target(arena, range);
    for (const Reference& reference : references_of(arena, range))
        target.add(reference,
                   mapping(reference.doubled_center())[int(split.axis)] < int(split.bin));
    target.finish(range, left, right);
    find_extents(arena, left, right);
}

bool partition(const geometry::Triangle* triangles, Arena& arena, const Range& range,
               const SpatialSplit& split, Range& left, Range& right) {
    Target target(arena, range);
    uint32_t remaining = range.size();
    for (const Reference& reference : references_of(arena, range)) {
        --remaining;
        const bool below = reference.lower[split.axis] < split.position;
        const bool above = reference.upper[split.axis] > split.position;
        if (below && above && target.room() >= remaining + 2) {
            const Halves halves =
                cut(triangles[reference.triangle()], reference, split.axis, split.position);
            if (!halves.below.empty())
                target.add(Reference::make(reference.triangle(), halves.below), true);
            if (!halves.above.empty())
                target.add(Reference::make(reference.triangle(), halves.above), false);
        } else {
            target.add(reference, reference.lower[split.axis] + reference.upper[split.axis]
                                      < 2 * split.position);
        }
    }
    if (target.lefts() == 0 || target.rights() == 0 || target.lefts() >= range.size()
        || target.rights() >= range.size())
        return false;
    target.finish(range, left, right);
    find_extents(arena, left, right);
    return true;
}

void halve(Arena& arena, const Range& range, Range& left, Range& right) {
    const Floats size = range.extent.centers.upper - range.extent.centers.lower;
    int axis = size[1] > size[0] ? 1 : 0;
    if (size[2] > size[axis]) axis = 2;
    const uint32_t half = range.size() / 2;
    const uint32_t lefts =
        range.size() > kBlockWidth ? (half + kBlockWidth - 1) / kBlockWidth * kBlockWidth : half;
    Reference* first = arena.data() + range.begin;
    std::nth_element(first, first + lefts, first + range.size(),
                     [axis](const Reference& a, const Reference& b) {
                         const float at = a.lower[axis] + a.upper[axis];
                         const float bt = b.lower[axis] + b.upper[axis];
                         return at != bt ? at < bt : a.biased_triangle < b.biased_triangle;
                     });
    Target target(arena, range);
    for (uint32_t i = 0; i < range.size(); ++i) target.add(first[i], i < lefts);
    target.finish(range, left, right);
    find_extents(arena, left, right);
}

} // namespace peregrine::accel::bvh
