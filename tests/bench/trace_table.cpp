#include "trace_table.h"

#include "means.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

namespace peregrine::bench {
namespace {

constexpr const char* kBestMode = "best of each scene";

// Ratios are there once there is a peer.
std::string ratio_text(double ratio) {
    if (std::isnan(ratio)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", ratio);
    return text;
}

// Each scene and kind of rays with our fastest mode, as peers get theirs.
std::vector<TraceRow> with_best_of_ours(const std::vector<TraceRow>& rows) {
    std::vector<TraceRow> best;
    for (const TraceRow& row : rows) {
        if (row.contestant != "peregrine") continue;
        const auto place = std::ranges::find_if(best, [&](const TraceRow& other) {
            return other.scene == row.scene && other.rays == row.rays;
        });
        if (place == best.end())
            best.push_back(row);
        else if (row.mrays_per_s > place->mrays_per_s)
            *place = row;
    }
    for (TraceRow& row : best) row.mode = kBestMode;
    best.insert(best.begin(), rows.begin(), rows.end());
    std::ranges::stable_sort(
        best, {}, [](const TraceRow& row) { return std::string_view("PSADRLN").find(row.rays); });
    return best;
}

struct Summary {
    explicit Summary(const TraceRow& row) : first(row) {}

    TraceRow first;
    Mean rate, ratio, level_ratio;
    double lowest = std::numeric_limits<double>::infinity();
    std::string lowest_scene;

    // Peers change their mode from scene to scene.
    bool covers(const TraceRow& row) const {
        return row.rays == first.rays && row.contestant == first.contestant
               && (row.mode == first.mode || row.contestant != "peregrine");
    }
    void add(const TraceRow& row) {
        rate.add(row.mrays_per_s);
        if (std::isnan(row.ratio_to_best_peer)) return;
        ratio.add(row.ratio_to_best_peer);
        if (is_level(row.scene)) level_ratio.add(row.ratio_to_best_peer);
        if (row.ratio_to_best_peer >= lowest) return;
        lowest = row.ratio_to_best_peer;
        lowest_scene = row.scene;
    }
    void print() const {
        const bool peer = first.contestant != "peregrine";
        std::printf("%-4c %-14s %-24s %9.2f %9s %9s %9s  %s\n", first.rays,
                    first.contestant.c_str(), peer ? kBestMode : first.mode.c_str(), rate.value(),
                    ratio_text(ratio.value()).c_str(), ratio_text(level_ratio.value()).c_str(),
                    ratio_text(lowest_scene.empty() ? ratio.value() : lowest).c_str(),
                    lowest_scene.c_str());
    }
};

} // namespace

void print_trace_header() {
    std::printf("%-4s %-14s %-24s %9s %9s %12s %12s\n", "rays", "contestant", "mode", "MRays/s",
                "ratio", "mismatches", "of rays");
}

void print_trace_row(const TraceRow& row) {
    std::printf("%-4c %-14s %-24s %9.2f %9s %12llu %12llu\n", row.rays, row.contestant.c_str(),
                row.mode.c_str(), row.mrays_per_s, ratio_text(row.ratio_to_best_peer).c_str(),
                static_cast<unsigned long long>(row.mismatches),
                static_cast<unsigned long long>(row.ray_count));
    std::fflush(stdout);
}

void print_trace_means(const std::vector<TraceRow>& rows) {
    std::vector<Summary> summaries;
    for (const TraceRow& row : with_best_of_ours(rows)) {
        auto place = std::ranges::find_if(summaries, [&](auto& s) { return s.covers(row); });
        if (place == summaries.end()) {
            summaries.emplace_back(row);
            place = summaries.end() - 1;
        }
        place->add(row);
    }
    std::printf("\ngeometric means over the scenes\n%-4s %-14s %-24s %9s %9s %9s %9s  %s\n", "rays",
                "contestant", "mode", "MRays/s", "ratio", "levels", "lowest", "where");
    for (const Summary& summary : summaries) summary.print();
}

std::string to_json(const std::vector<TraceRow>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const TraceRow& row : rows)
        list.push_back({{"scene", row.scene},
                        {"rays", std::string(1, row.rays)},
                        {"contestant", row.contestant},
                        {"mode", row.mode},
                        {"compact", row.compact},
                        {"threads", row.threads},
                        {"mrays_per_s", row.mrays_per_s},
                        {"ratio_to_best_peer", row.ratio_to_best_peer},
                        {"mismatches", row.mismatches},
                        {"build_ms", row.build_ms},
                        {"bytes_per_triangle", row.bytes_per_triangle}});
    return list.dump(2);
}

} // namespace peregrine::bench
