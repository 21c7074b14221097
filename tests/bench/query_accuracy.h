#pragma once

#include "query_contestant.h"
#include "reference.h"

#include <vector>

namespace peregrine::bench {

// Differences that are not held against anyone, in metres: 0.1 mm.
constexpr double kBand = 1e-4;

// What the reference says to the first queries of a set. One list is filled.
struct ReferenceAnswers {
    std::vector<Contact> contacts;              // closest, stream, sweep, nearest
    std::vector<Truth> truths;                  // any, overlap
    std::vector<std::vector<double>> crossings; // all; `truths` is open where one is uncertain

    size_t size() const { return contacts.size() + truths.size(); }
};

ReferenceAnswers answer_by_reference(const Reference& reference, const QuerySet& set, size_t count);

struct Accuracy {
    double missed_per_million = 0;          // said nothing where there surely is something
    double false_per_million = 0;           // said something where there surely is nothing
    double median_error_mm, worst_error_mm; // of distances along the way; NaN where there are none
    size_t judged = 0;                      // queries
};

// `scale`: of the level; bands and errors are those of the level in its own size.
Accuracy judge(const QuerySet& set, const QueryAnswers& answers, const ReferenceAnswers& reference,
               double scale);

} // namespace peregrine::bench
