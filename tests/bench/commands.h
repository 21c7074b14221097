#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::bench {

// What all commands of peregrine_bench have in common.
struct Options {
    std::vector<std::string> scenes; // files
    std::vector<std::string> peers;
    uint32_t threads = 1;
    uint32_t passes = 5;
    uint32_t size = 1024;
    std::vector<std::string> rays; // letters of trace_rays.h
    std::string structure = "auto";
    std::string build = "balanced";
    std::string peer_build = "high";
    std::string isa = "best";
    float empty_bonus = 0;
    std::string library;
    std::string json;
};

// Each prints a table, and returns its rows as JSON text.
std::string run_build(const Options& options);
std::string run_frame(const Options& options);
std::string run_door(const Options& options);
std::string run_trace(const Options& options);
std::string run_grenade(const Options& options);
std::string run_kernels(const Options& options);

} // namespace peregrine::bench
