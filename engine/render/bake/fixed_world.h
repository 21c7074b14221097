#pragma once

#include "scene/snapshot.h"

namespace peregrine::render::bake {

// What is left of a snapshot without what moves, what comes from all around, and air.
struct FixedWorld {
    FixedWorld(const scene::Snapshot& whole, base::Memory* memory);

    scene::Snapshot snapshot;
};

} // namespace peregrine::render::bake
