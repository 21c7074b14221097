#include "scene/snapshot_store.h"

#include <algorithm>

namespace peregrine::scene {
namespace {

// A handle that no store has gives a slot whose generation is another one.
uint32_t slot_of(base::Handle held) {
    return held.index % SnapshotStore::kMostHeld;
}

} // namespace

SnapshotStore::SnapshotStore(uint32_t first_generation, base::Memory* memory)
    : memory_(memory), retired_(memory) {
    for (Held& held : held_) held.generation.store(first_generation, std::memory_order_relaxed);
}

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

SnapshotStore::Pin::Pin(const SnapshotStore& store, base::Handle held)
    : hazard_(store.held_[slot_of(held)].snapshot),
      is_stale_(held.index >= kMostHeld
                || store.held_[held.index].generation.load(std::memory_order_acquire)
                       != held.generation) {}

base::Handle SnapshotStore::hold() {
    const std::lock_guard lock(holding_);
    const base::Hazard current(current_);
    if (!current.object()) return {};
    const auto free = std::ranges::find_if(held_, [](const Held& held) {
        return held.snapshot.load(std::memory_order_relaxed) == nullptr;
    });
    if (free == held_.end())
        base::fail(base::Code::limit, "the scene holds %u snapshots; release some", kMostHeld);
    auto* snapshot = static_cast<Snapshot*>(const_cast<void*>(current.object()));
    snapshot->holds.fetch_add(1, std::memory_order_acq_rel);
    free->snapshot.store(snapshot, std::memory_order_release);
    return {uint32_t(free - held_.begin()), free->generation.load(std::memory_order_relaxed)};
}

bool SnapshotStore::release(base::Handle handle) {
    const std::lock_guard lock(holding_);
    if (handle.index >= kMostHeld) return false;
    Held& held = held_[handle.index];
    Snapshot* const snapshot = held.snapshot.load(std::memory_order_relaxed);
    const uint32_t generation = held.generation.load(std::memory_order_relaxed);
    if (!snapshot || generation != handle.generation) return false;
    held.generation.store(generation + 1 == 0 ? 1 : generation + 1, std::memory_order_release);
    held.snapshot.store(nullptr, std::memory_order_release);
    snapshot->holds.fetch_sub(1, std::memory_order_acq_rel);
    return true;
}

uint32_t SnapshotStore::reclaim() noexcept {
    const auto is_held = [](const Snapshot* snapshot) {
        return snapshot->holds.load(std::memory_order_acquire) != 0;
    };
    // Out of reach before the barrier, except for those who announced them by then: these may be
    // about to hold them, so look again.
    const auto unreachable = std::partition(retired_.begin(), retired_.end(), is_held);
    if (unreachable != retired_.end()) {
        base::Hazard::writer_barrier();
        const auto freed = std::partition(unreachable, retired_.end(), [&](Snapshot* snapshot) {
            return base::Hazard::is_announced(snapshot) || is_held(snapshot);
        });
        std::for_each(freed, retired_.end(), [&](Snapshot* snapshot) { destroy(snapshot); });
        retired_.erase(freed, retired_.end());
    }
    return uint32_t(retired_.size()) + (current_.load(std::memory_order_relaxed) ? 1 : 0);
}

} // namespace peregrine::scene
