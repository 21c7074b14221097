#pragma once

#include "base/isa.h"

// PEREGRINE_TABLE_FOR(isa, kTable): the address of the kTable of an instruction set's namespace;
// null if it was not compiled. Does not ask the machine. For the HWY_ONCE part of a source, in the
// namespace that holds those of the instruction sets.
#if HWY_TARGETS & HWY_SSE4
#define PEREGRINE_TABLE_SSE4(table) &N_SSE4::table
#else
#define PEREGRINE_TABLE_SSE4(table) nullptr
#endif
#if HWY_TARGETS & HWY_AVX2
#define PEREGRINE_TABLE_AVX2(table) &N_AVX2::table
#else
#define PEREGRINE_TABLE_AVX2(table) nullptr
#endif
#if HWY_TARGETS & HWY_AVX3
#define PEREGRINE_TABLE_AVX3(table) &N_AVX3::table
#else
#define PEREGRINE_TABLE_AVX3(table) nullptr
#endif
#if HWY_TARGETS & HWY_NEON
#define PEREGRINE_TABLE_NEON(table) &N_NEON::table
#else
#define PEREGRINE_TABLE_NEON(table) nullptr
#endif

#define PEREGRINE_TABLE_FOR(isa, table)                                                            \
    ((isa) == base::Isa::sse4     ? PEREGRINE_TABLE_SSE4(table)                                    \
     : (isa) == base::Isa::avx2   ? PEREGRINE_TABLE_AVX2(table)                                    \
     : (isa) == base::Isa::avx512 ? PEREGRINE_TABLE_AVX3(table)                                    \
     : (isa) == base::Isa::neon   ? PEREGRINE_TABLE_NEON(table)                                    \
                                  : nullptr)
