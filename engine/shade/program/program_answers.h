#pragma once

#include "scene/program.h"
#include "scene/snapshot.h"
#include "shade/path/path_rays.h"
#include "shade/program/program_memory.h"
#include "shade/scratch.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/space.h"

#include <cstdint>

namespace peregrine::shade {

// Takes what a program says of its hits: those of memory.spans and memory.runs. What can't be is 0,
// and counted. Most of it is loops over arrays, from where hits are packed to where they are in the
// batch.
class ProgramAnswers {
public:
    // `rays` null: what they would find is the ambient light.
    ProgramAnswers(const scene::Snapshot& snapshot, const SurfaceSpace& space, const RayHits& hits,
                   const Scratch& scratch, const AskedRays* rays)
        : snapshot_(snapshot), space_(space), hits_(hits), scratch_(scratch),
          memory_(*scratch.programs), rays_(rays) {}

    void take(const scene::HostProgram& program, float* const radiance[3]) const;

private:
    using Span = ProgramMemory::Span;

    void make_sane(bool asks) const;
    void aim() const;
    void aim(const Span& span, uint32_t first) const;
    void cover() const;
    bool any_ray() const;
    void add_ambient() const;
    void send() const;
    void send_through() const;

    const scene::Snapshot& snapshot_;
    const SurfaceSpace& space_;
    const RayHits& hits_;
    const Scratch& scratch_;
    ProgramMemory& memory_;
    const AskedRays* rays_;
};

} // namespace peregrine::shade
