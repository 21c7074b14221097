#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::bvh {

// As in trace/kernels.h.
struct StreamKernels {
    void (*closest)(const Target& target, const RayStream& rays, const Filter& filter,
                    const HitStream& hits);
    void (*occluded)(const Target& target, const RayStream& rays, const Filter& filter,
                     uint8_t* occluded);
};

// For full trees and compact ones. Null if not compiled for this instruction set. Does not ask the
// machine.
const StreamKernels* stream_kernels(base::Isa isa);

} // namespace peregrine::trace::bvh
