#pragma once

#include "trace/kernels.h"

namespace peregrine::trace::bih {

Kernels make_kernels(base::Isa isa);

} // namespace peregrine::trace::bih
