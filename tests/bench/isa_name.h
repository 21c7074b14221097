#pragma once

#include <peregrine/rt.h>

#include <map>
#include <string>

namespace peregrine::bench {

inline rt_isa to_isa(const std::string& name) {
    static const std::map<std::string, rt_isa> isas = {
        {"best", RT_ISA_BEST}, {"scalar", RT_ISA_SCALAR}, {"sse4", RT_ISA_SSE4},
        {"avx2", RT_ISA_AVX2}, {"avx512", RT_ISA_AVX512},
    };
    return isas.at(name);
}

} // namespace peregrine::bench
