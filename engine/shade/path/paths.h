#pragma once

#include "shade/air/airlight.h"
#include "shade/air/fog.h"
#include "shade/path/path_rays.h"
#include "shade/shader.h"
#include "trace/filter.h"

#include <cstdint>

namespace peregrine::shade {

struct PathLimits {
    uint32_t max_depth = 0; // 0: there are no paths
    float least_weight = 0; // of a ray, to be traced
};

// What mirrors and glass show of a tile, once the rays from the eye are known. Rays that go on wait
// in chunks, mirrored ones and those that came through apart. A chunk is traced and shaded as a
// whole; what goes on from it is followed to its end before the next one. So two chunks of each
// depth are enough, and the order in which light is added up depends on the tile alone. Read-only:
// all threads share it.
class Paths {
public:
    // `filter`: of primary rays. `eye`: what the eye is in.
    Paths(const scene::Snapshot& snapshot, const Shader& shader, const Fog& fog,
          const Airlight& airlight, const trace::Filter& filter, const PathLimits& limits,
          const Media& eye);

    bool any() const { return limits_.max_depth > 0; }
    uint32_t chunk_count() const { return 2 * limits_.max_depth; }
    void begin(PathRays* chunks, PathMemory& memory) const; // of zeroed memory

    // Of a batch of rays from the eye: to be called when scratch.surface is known, ...
    void split(const RayHits& hits, PathMemory& memory, Scratch& scratch) const;
    // ... where programs ask for rays beside that, ...
    AskedRays asked_rays(PathMemory& memory) const { return {memory.split, memory.eye_media}; }
    // ... and when the colours are, of which the batch begins at `first`; hits.t is not scaled.
    void keep(const RayHits& hits, float* const colors[3], uint32_t first, PathMemory& memory,
              Scratch& scratch) const;

    // Adds to the colours what the rays find that wait.
    void follow(float* const colors[3], PathMemory& memory, Scratch& scratch) const {
        follow(1, colors, memory, scratch);
    }

private:
    struct Batch; // paths.cpp

    void follow(uint32_t depth, float* const colors[3], PathMemory& memory, Scratch& scratch) const;
    void trace(PathRays& rays, PathMemory& memory) const;
    void shade(const Batch& batch, float* const colors[3], PathMemory& memory,
               Scratch& scratch) const;
    void split(const RayHits& hits, const Media* media, PathMemory& memory, Scratch& scratch) const;
    bool absorb(const RayHits& hits, const float* t, const Media* media, PathMemory& memory) const;
    void hide_in_fog(const Batch& batch, float* const radiance[3], PathMemory& memory,
                     Scratch& scratch) const;
    void dim(uint32_t count, PathMemory& memory) const;
    void send_on(const Batch& batch, const SplitRays::Branch& branch, PathRays* to,
                 float* const colors[3], PathMemory& memory) const;
    void send_on(const Batch& batch, float* const colors[3], PathMemory& memory) const;

    const scene::Snapshot* snapshot_;
    const Shader* shader_;
    const Fog* fog_;           // null: none
    const Airlight* airlight_; // null: none
    trace::Filter filter_;
    PathLimits limits_;
    Media eye_;
};

} // namespace peregrine::shade
