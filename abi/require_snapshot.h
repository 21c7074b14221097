#pragma once

#include "check.h"
#include "scene/snapshot_store.h"

namespace peregrine::abi {

// Pins what a call asks: a held snapshot, or the current one if `held` is null.
inline scene::SnapshotStore::Pin pin_snapshot(const scene::SnapshotStore& store, rt_snapshot held) {
    return to_handle(held) == base::Handle{} ? scene::SnapshotStore::Pin(store)
                                             : scene::SnapshotStore::Pin(store, to_handle(held));
}

// What was pinned. Throws base::Error invalid_handle if `held` is stale, not_committed if the scene
// has no snapshot yet.
inline const scene::Snapshot& require_snapshot(const scene::SnapshotStore::Pin& pin,
                                               rt_snapshot held = {}) {
    if (!pin.get()) [[unlikely]] {
        if (to_handle(held) != base::Handle{})
            fail_handle(to_handle(held), "rt_snapshot", "held snapshot");
        base::fail(base::Code::not_committed,
                   "the scene has no snapshot yet: call rt_commit_scene");
    }
    return *pin.get();
}

} // namespace peregrine::abi
