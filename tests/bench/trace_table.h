#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::bench {

// What one contestant did with one set of rays.
struct TraceRow {
    std::string scene;
    char rays;
    std::string contestant, mode;
    bool compact;
    uint32_t threads;
    double mrays_per_s;
    double ratio_to_best_peer; // NaN without peers
    uint64_t ray_count, mismatches;
    double build_ms, bytes_per_triangle;
};

void print_trace_header();
void print_trace_row(const TraceRow& row);

// Per kind of rays, contestant and mode: geometric means of rates and ratios over the scenes.
void print_trace_means(const std::vector<TraceRow>& rows);

std::string to_json(const std::vector<TraceRow>& rows);

} // namespace peregrine::bench
