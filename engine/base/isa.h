#pragma once

#include <cstdint>

namespace peregrine::base {

// Instruction sets that kernels exist for. `scalar` is plain C++ and runs everywhere.
enum class Isa : uint32_t { best = 0, sse4 = 1, avx2 = 2, avx512 = 3, scalar = 4, neon = 5 };

// Whether this machine can run it and this build has kernels for it; true for `best` and `scalar`.
bool is_available(Isa isa);

// The widest that is.
Isa best_isa();

} // namespace peregrine::base
