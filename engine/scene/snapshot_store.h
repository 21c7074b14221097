#pragma once

#include "base/hazard.h"
#include "base/memory.h"
#include "base/slot_map.h"
#include "scene/snapshot.h"

#include <array>
#include <atomic>
#include <mutex>

namespace peregrine::scene {

// The current snapshot of a scene, and the old ones that readers still use or the host holds. Any
// number of threads pin, hold and release; one at a time publishes.
class SnapshotStore {
public:
    static constexpr uint32_t kMostHeld = 256;

    // `first_generation` as of base::SlotMap.
    SnapshotStore(uint32_t first_generation, base::Memory* memory);
    ~SnapshotStore(); // when no reader is left

    // Keeps the snapshot that is current now, if any, alive and unchanged.
    class Pin {
    public:
        explicit Pin(const SnapshotStore& store) : hazard_(store.current_) {}
        // ... or the one that is held under the handle: none if it is stale.
        Pin(const SnapshotStore& store, base::Handle held);
        const Snapshot* get() const {
            return is_stale_ ? nullptr : static_cast<const Snapshot*>(hazard_.object());
        }

    private:
        base::Hazard hazard_;
        bool is_stale_ = false;
    };

    // Keeps the current snapshot under a handle. Null: there is none. Throws base::Error limit.
    base::Handle hold();
    bool release(base::Handle held); // false: the handle is stale

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
    // Whoever read the snapshot before the generation knows which handle it belonged to.
    struct Held {
        std::atomic<Snapshot*> snapshot{nullptr};
        std::atomic<uint32_t> generation{0};
    };

    std::atomic<Snapshot*> current_{nullptr};
    base::Vector<Snapshot*> retired_;
    std::array<Held, kMostHeld> held_;
    std::mutex holding_; // of hold and release
};

} // namespace peregrine::scene
