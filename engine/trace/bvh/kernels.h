#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::bvh {

Kernels make_kernels(base::Isa isa);
Kernels make_compact_kernels(base::Isa isa);

} // namespace peregrine::trace::bvh
