#pragma once

#include "query_accuracy.h"

#include <string>
#include <vector>

namespace peregrine::bench {

// What one contestant did with one set of queries.
struct QueryRow {
    std::string scene, item, contestant;
    double per_s;
    Accuracy accuracy;
};

void print_query_header(const std::string& scene);
void print_query_row(const QueryRow& row);
std::string to_json(const std::vector<QueryRow>& rows);

} // namespace peregrine::bench
