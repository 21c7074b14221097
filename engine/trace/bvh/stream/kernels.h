#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::bvh {

// They do not say whose they are. Null if not compiled for this instruction set. Does not ask the
// machine.
const Kernels* simd_kernels(base::Isa isa, bool compact);

} // namespace peregrine::trace::bvh
