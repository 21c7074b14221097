#pragma once

#include "base/progress.h"
#include "base/scheduler.h"
#include "scene/snapshot.h"

#include <cstdint>
#include <memory>

namespace peregrine::render::bake {

struct Options {
    uint32_t samples = 64;   // rays a point, at most shade::kMostOpenRays
    float range = 1;         // of openness, in metres; may be infinite; 0: it is not asked
    uint32_t bounces = 1;    // of light between surfaces; 0: it is not asked
    float spacing = 0.5f;    // metres: points of openness get as near to each other where it ...
    float tolerance = 0.05f; // ... is not what lies between their neighbours
    uint64_t most_bytes = uint64_t(64) << 20;
    base::Progress progress;
};

struct Report {
    uint64_t points = 0;  // that are kept
    uint64_t sampled = 0; // of all bounces
    uint64_t rays = 0;
    uint64_t bytes = 0;
    double ms = 0;
};

// The light map of a snapshot's fixed meshes, lit by all of its lamps: the same bits with any
// number of threads; null if there are none. Throws base::Error: cancelled by progress; limit, if
// not even the corners of all triangles fit into most_bytes.
std::shared_ptr<const scene::LightMap> bake(const scene::Snapshot& snapshot, const Options& options,
                                            base::Scheduler& scheduler, base::Memory* memory,
                                            Report& report);

} // namespace peregrine::render::bake
