#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::bvh {

// As in trace/kernels.h.
struct SingleKernels {
    Hit (*closest)(const Target& target, const math::Ray& ray, const Filter& filter);
    bool (*occluded)(const Target& target, const math::Ray& ray, const Filter& filter);
    void (*visit)(const Target& target, const math::Ray& ray, Visitor& visitor);
};

// Null if not compiled for this instruction set. Does not ask the machine.
const SingleKernels* single_kernels(base::Isa isa, bool compact);

} // namespace peregrine::trace::bvh
