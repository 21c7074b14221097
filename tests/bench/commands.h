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
    std::string frame_size = "1024x1024";
    std::vector<std::string> looks; // of frames
    float least_light = 0;          // steps of the display
    uint32_t first_passes = 3;      // of passes, how many measure first frames as well
    std::vector<std::string> rays;  // letters of trace_rays.h
    std::vector<std::string> modes; // of ours; none: all
    std::string structure = "auto";
    std::string build = "balanced";
    bool compact = false;
    std::string peer_build = "high";
    std::string isa = "best";
    float empty_bonus = 0;
    std::vector<std::string> items; // of queries
    size_t count = 100'000;         // queries an item ...
    size_t reference = 20'000;      // ... and how many of them are judged
    std::string library;
    float way = 0; // metres; 0: the default of the command
    std::string json;
    std::string pictures; // folder for them
};

// Each prints a table, and returns its rows as JSON text.
std::string run_features(const Options& options);
std::string run_paper(const Options& options);
std::string run_build(const Options& options);
std::string run_frame(const Options& options);
std::string run_prices(const Options& options);
std::string run_door(const Options& options);
std::string run_trace(const Options& options);
std::string run_moving(const Options& options);
std::string run_grenade(const Options& options);
std::string run_glass(const Options& options);
std::string run_falloff(const Options& options);
std::string run_kernels(const Options& options);
std::string run_lamps(const Options& options);
std::string run_programs(const Options& options);
std::string run_queries(const Options& options);
std::string run_triangles(const Options& options);

std::vector<std::string> query_item_names();
std::string query_item_legend();

} // namespace peregrine::bench
