#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::kdtree {

Kernels make_kernels(base::Isa isa);

} // namespace peregrine::trace::kdtree
