#include "trace_check.h"

#include <bit>
#include <cmath>

namespace peregrine::bench {
namespace {

constexpr float kTolerance = 1e-4f; // of t

bool same_bits(float a, float b) {
    return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

bool agrees(const Answer& answer, const Answer& exact) {
    if (answer.triangle == exact.triangle) return true;
    if (answer.triangle == geometry::kNoTriangle || exact.triangle == geometry::kNoTriangle)
        return false;
    return std::fabs(answer.t - exact.t) <= kTolerance * std::fabs(exact.t);
}

} // namespace

std::vector<Answer> exact_answers(const Tracer& exact, const RaySet& set) {
    Results results;
    exact.prepare(set, results);
    exact.trace(0, set, 0, set.rays.size(), results);
    std::vector<Answer> answers(set.rays.size());
    for (size_t i = 0; i < answers.size(); ++i) answers[i] = exact.answer(0, set, results, i);
    return answers;
}

uint64_t count_mismatches(const Tracer& tracer, size_t mode, bool bit_by_bit, const RaySet& set,
                          const Results& results, const std::vector<Answer>& exact) {
    uint64_t mismatches = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        const Answer answer = tracer.answer(mode, set, results, i);
        mismatches += bit_by_bit
                          ? answer.triangle != exact[i].triangle || !same_bits(answer.t, exact[i].t)
                          : !agrees(answer, exact[i]);
    }
    return mismatches;
}

} // namespace peregrine::bench
