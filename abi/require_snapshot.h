#pragma once

#include "base/error.h"
#include "scene/snapshot_store.h"

namespace peregrine::abi {

// What was pinned; throws base::Error not_committed if the scene has no snapshot yet.
inline const scene::Snapshot& require_snapshot(const scene::SnapshotStore::Pin& pin) {
    if (!pin.get()) [[unlikely]]
        base::fail(base::Code::not_committed,
                   "the scene has no snapshot yet: call rt_commit_scene");
    return *pin.get();
}

} // namespace peregrine::abi
