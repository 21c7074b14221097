#include "base/isa.h"

#include <initializer_list>

namespace peregrine::base {
namespace {

// CMake's PEREGRINE_TARGETS may leave out all sets but one.
constexpr bool is_built(Isa isa) {
#if defined(PEREGRINE_ONLY_ISA)
    return isa == Isa::PEREGRINE_ONLY_ISA || isa == Isa::best || isa == Isa::scalar;
#else
    return isa <= Isa::neon;
#endif
}

bool machine_has(Isa isa) {
    switch (isa) {
    case Isa::best:
    case Isa::scalar:
        return true;
#if defined(__x86_64__)
    // What Highway's targets of these names use.
    case Isa::sse4:
        return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes")
               && __builtin_cpu_supports("pclmul");
    case Isa::avx2:
        return machine_has(Isa::sse4) && __builtin_cpu_supports("avx2")
               && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi")
               && __builtin_cpu_supports("bmi2"); // F16C came earlier than AVX2, everywhere
    case Isa::avx512:
        return machine_has(Isa::avx2) && __builtin_cpu_supports("avx512f")
               && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")
               && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
#endif
#if defined(__aarch64__)
    case Isa::neon:
        return true;
#endif
    default:
        return false;
    }
}

} // namespace

bool is_available(Isa isa) {
    return is_built(isa) && machine_has(isa);
}

Isa best_isa() {
    for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::sse4, Isa::neon})
        if (is_available(isa)) return isa;
    return Isa::scalar;
}

} // namespace peregrine::base
