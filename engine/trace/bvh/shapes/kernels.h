#pragma once

#include "base/isa.h"
#include "trace/shapes/shapes.h"

namespace peregrine::trace::bvh {

// For this instruction set, or the plain ones if it was not compiled. Does not ask the machine.
const ShapeKernels& shape_kernels(base::Isa isa);

} // namespace peregrine::trace::bvh
