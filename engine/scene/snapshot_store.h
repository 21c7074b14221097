#pragma once

#include "base/hazard.h"
#include "base/memory.h"
#include "scene/snapshot.h"

#include <atomic>

namespace peregrine::scene {

// The current snapshot of a scene, and the old ones that readers still use. Any number of threads
// pin; one at a time publishes.
class SnapshotStore {
public:
    explicit SnapshotStore(base::Memory* memory) : memory_(memory), retired_(memory) {}
    ~SnapshotStore(); // when no reader is left

    // Keeps the snapshot that is current now, if any, alive and unchanged.
    class Pin {
    public:
        explicit Pin(const SnapshotStore& store) : hazard_(store.current_) {}
        const Snapshot* get() const { return static_cast<const Snapshot*>(hazard_.object()); }

    private:
        base::Hazard hazard_;
    };

    // Room for one more, so that publish cannot fail.
    void reserve() { retired_.reserve(retired_.size() + 1); }
    Snapshot* create(); // to be published or destroyed
    void destroy(Snapshot* snapshot) noexcept;
    void publish(Snapshot* snapshot) noexcept;

    // Frees what no reader uses any more; returns how many snapshots are left, the current one
    // included.
    uint32_t reclaim() noexcept;

private:
    base::Memory* memory_;
    std::atomic<Snapshot*> current_{nullptr};
    base::Vector<Snapshot*> retired_;
};

} // namespace peregrine::scene
