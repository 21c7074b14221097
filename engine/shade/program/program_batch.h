#pragma once

#include "scene/program.h"
#include "scene/snapshot.h"
#include "shade/program/program_memory.h"
#include "shade/scratch.h"
#include "shade/surface/ray_hits.h"
#include "shade/surface/space.h"

namespace peregrine::shade {

// Packs what a program wants of its hits: those of memory.spans and memory.runs.
class BatchPacker {
public:
    // `features`, `space` as of Programs. Needs scratch.surface and scratch.light.
    BatchPacker(const scene::Snapshot& snapshot, uint32_t features, const SurfaceSpace& space,
                const RayHits& hits, const Scratch& scratch, Surroundings from);

    scene::ProgramBatch pack(const scene::HostProgram& program);

private:
    using Lanes = Surface::Lanes;
    const float* pack(const float* from, Lanes& to) const;
    template <size_t Count>
    void pack(const Lanes (&from)[Count], Lanes (&to)[Count], const float* (&out)[Count]) const;
    template <class Value>
    const Value* pad(Value* values) const;

    void pack_place();
    void pack_way();
    void pack_texcoords();
    void pack_names();
    void pack_look();
    void pack_light();
    void clear_answers();

    const scene::Snapshot& snapshot_;
    uint32_t features_;
    const SurfaceSpace& space_;
    const RayHits& hits_;
    const Scratch& scratch_;
    ProgramMemory& memory_;
    Surroundings from_;
    const scene::HostProgram* program_ = nullptr;
    scene::ProgramBatch batch_;
};

} // namespace peregrine::shade
