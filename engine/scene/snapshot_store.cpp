#include "scene/snapshot_store.h"

namespace peregrine::scene {

SnapshotStore::~SnapshotStore() {
    for (Snapshot* snapshot : retired_) destroy(snapshot);
    if (Snapshot* snapshot = current_.load()) destroy(snapshot);
}

Snapshot* SnapshotStore::create() {
    return std::pmr::polymorphic_allocator<>(memory_).new_object<Snapshot>(memory_);
}

void SnapshotStore::destroy(Snapshot* snapshot) noexcept {
    std::pmr::polymorphic_allocator<>(memory_).delete_object(snapshot);
}

void SnapshotStore::publish(Snapshot* snapshot) noexcept {
    if (Snapshot* old = current_.exchange(snapshot, std::memory_order_acq_rel))
        retired_.push_back(old); // reserve() made room
    reclaim();
}

uint32_t SnapshotStore::reclaim() noexcept {
    if (!retired_.empty()) {
        base::Hazard::writer_barrier();
        std::erase_if(retired_, [&](Snapshot* snapshot) {
            if (base::Hazard::is_announced(snapshot)) return false;
            destroy(snapshot);
            return true;
        });
    }
    return uint32_t(retired_.size()) + (current_.load(std::memory_order_relaxed) ? 1 : 0);
}

} // namespace peregrine::scene
