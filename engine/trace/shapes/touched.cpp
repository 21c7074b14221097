#include "trace/shapes/shapes.h"

#include <algorithm>

namespace peregrine::trace {

void Touched::restart(uint64_t first) {
    first_ = first;
    limit_ = ~uint64_t(0);
    count_ = 0;
}

void Touched::add(uint64_t key) {
    if (!wants(key)) return;
    keys_[count_++] = key;
    if (count_ == 2 * kRoom) compact();
}

void Touched::finish() {
    compact();
}

void Touched::compact() {
    std::sort(keys_, keys_ + count_);
    count_ = uint32_t(std::unique(keys_, keys_ + count_) - keys_);
    if (count_ < kRoom) return;
    count_ = kRoom;
    limit_ = keys_[kRoom - 1];
}

} // namespace peregrine::trace
