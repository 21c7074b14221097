#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::kdtree {

struct StreamKernels {
    void (*closest)(const Target& target, const RayStream& rays, const Filter& filter,
                    const HitStream& hits);
    void (*occluded)(const Target& target, const RayStream& rays, const Filter& filter,
                     uint8_t* occluded);
};

// Null if not compiled for this instruction set. Does not ask the machine.
const StreamKernels* stream_kernels(base::Isa isa);

} // namespace peregrine::trace::kdtree
