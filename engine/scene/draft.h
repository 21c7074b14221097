#pragma once

#include "scene/snapshot_store.h"

#include <utility>

namespace peregrine::scene {

// A snapshot on its way; destroyed unless it was published.
class Draft {
public:
    explicit Draft(SnapshotStore& store) : store_(store), snapshot_(store.create()) {}
    ~Draft() {
        if (snapshot_) store_.destroy(snapshot_);
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    Snapshot& operator*() { return *snapshot_; }
    void publish() { store_.publish(std::exchange(snapshot_, nullptr)); }

private:
    SnapshotStore& store_;
    Snapshot* snapshot_;
};

} // namespace peregrine::scene
