#include "query_table.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

std::string millimetres(double value) {
    if (std::isnan(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, value < 10 ? "%.4f" : "%.1f", value);
    return text;
}

} // namespace

void print_query_header(const std::string& scene) {
    std::printf("\n%s\n%-18s %-16s %10s %11s %11s %10s %10s %9s\n", scene.c_str(), "item",
                "contestant", "1000/s", "missed/M", "false/M", "median mm", "worst mm", "judged");
}

void print_query_row(const QueryRow& row) {
    const Accuracy& accuracy = row.accuracy;
    std::printf("%-18s %-16s %10.0f %11.0f %11.0f %10s %10s %9zu\n", row.item.c_str(),
                row.contestant.c_str(), 1e-3 * row.per_s, accuracy.missed_per_million,
                accuracy.false_per_million, millimetres(accuracy.median_error_mm).c_str(),
                millimetres(accuracy.worst_error_mm).c_str(), accuracy.judged);
    std::fflush(stdout);
}

std::string to_json(const std::vector<QueryRow>& rows) {
    nlohmann::json list = nlohmann::json::array(); // what is NaN becomes null
    for (const QueryRow& row : rows)
        list.push_back({{"scene", row.scene},
                        {"item", row.item},
                        {"contestant", row.contestant},
                        {"per_s", row.per_s},
                        {"missed_per_million", row.accuracy.missed_per_million},
                        {"false_per_million", row.accuracy.false_per_million},
                        {"median_error_mm", row.accuracy.median_error_mm},
                        {"worst_error_mm", row.accuracy.worst_error_mm},
                        {"judged", row.accuracy.judged}});
    return list.dump(2);
}

} // namespace peregrine::bench
