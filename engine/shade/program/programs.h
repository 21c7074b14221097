#pragma once

#include "scene/snapshot.h"
#include "shade/light/illumination.h"
#include "shade/program/program_memory.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/space.h"

#include <cstdint>

namespace peregrine::shade {

struct AskedRays;
struct Scratch;

// What surfaces show that a program of the host shades. Read-only: all threads share it.
class Programs {
public:
    // `features` as of Shader; surfaces are relative to `space.origin`.
    Programs(const scene::Snapshot& snapshot, uint32_t features, const SurfaceSpace& space);

    bool any() const { return any_; }

    // While light is gathered for hits alone, not for their neighbours as well, surfaces face
    // nowhere whose programs don't ask for it: no ray is traced for them.
    bool spare_light() const { return some_are_unlit_; }
    void turn_away(const RayHits& hits, Scratch& scratch) const;
    void turn_back(Scratch& scratch) const;

    // Puts their radiance in the place of what scratch.surface and scratch.light made.
    // `from`: what scratch.light has. `rays` null: what they ask for is not traced.
    void run(const RayHits& hits, float* const radiance[3], Scratch& scratch, Surroundings from,
             const AskedRays* rays) const;

private:
    bool find_programs(const RayHits& hits, Scratch& scratch) const;
    void collect(uint32_t program, const Surface& surface, ProgramMemory& memory) const;

    const scene::Snapshot* snapshot_;
    SurfaceSpace space_;
    uint32_t features_;
    bool any_;
    bool some_are_unlit_ = false;
};

} // namespace peregrine::shade
