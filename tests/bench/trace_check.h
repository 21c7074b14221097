#pragma once

#include "tracer.h"

#include <vector>

namespace peregrine::bench {

// The right answers to a set of rays: those of the scalar kernel, a ray at a time.
std::vector<Answer> exact_answers(const Tracer& exact, const RaySet& set);

// How many answers are wrong. Ours must be the exact ones bit by bit. A peer's may name another
// triangle at the same place: t within 1e-4 of its size.
uint64_t count_mismatches(const Tracer& tracer, size_t mode, bool bit_by_bit, const RaySet& set,
                          const Results& results, const std::vector<Answer>& exact);

} // namespace peregrine::bench
