#include "frame_table.h"

#include "means.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace peregrine::bench {
namespace {

std::string text_of(double value, int digits) {
    if (std::isnan(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

// Of the rows of a look.
struct Summary {
    Mean all, all_first, levels, levels_first;
    double hall = FrameRow::kNone, hall_first = FrameRow::kNone;
    double highest = 0;
    std::string highest_scene;

    void add(const FrameRow& row) {
        all.add(row.ratio());
        all_first.add(row.first_ratio());
        if (is_level(row.scene)) {
            levels.add(row.ratio());
            levels_first.add(row.first_ratio());
        }
        if (row.scene == "hall") {
            hall = row.ratio();
            hall_first = row.first_ratio();
        }
        if (row.ratio() > highest) {
            highest = row.ratio();
            highest_scene = row.scene;
        }
    }
    void print(const std::string& look) const {
        std::printf("%-11s", look.c_str());
        for (const double value : {all.value(), all_first.value(), levels.value(),
                                   levels_first.value(), hall, hall_first, highest})
            std::printf(" %7s", text_of(value, 2).c_str());
        std::printf("  %s\n", highest_scene.c_str());
    }
};

} // namespace

void print_frame_header() {
    std::printf("%-16s %-11s %8s %8s %8s %6s %6s %9s %9s %8s %8s %9s %9s %7s\n", "scene", "look",
                "ms", "first ms", "peer ms", "ratio", "first", "primary", "shadow", "proofs",
                "MRays/s", "a GHz,core", "FLIP mean", "worst");
}

void print_frame_row(const FrameRow& row) {
    std::printf("%-16s %-11s %8.2f %8s %8s %6s %6s %9.0f %9.0f %8llu %8.2f %9.2f %9s %7s  %s\n",
                row.scene.c_str(), row.look.c_str(), row.frame_ms,
                text_of(row.first_frame_ms, 2).c_str(), text_of(row.peer_primary_ms, 2).c_str(),
                text_of(row.ratio(), 2).c_str(), text_of(row.first_ratio(), 2).c_str(),
                row.rays_primary, row.rays_shadow, static_cast<unsigned long long>(row.proofs),
                row.mrays_per_s, row.mrays_per_s_per_ghz_and_core,
                text_of(row.flip_mean, 4).c_str(), text_of(row.flip_worst_tile, 3).c_str(),
                row.peer_mode.c_str());
    std::fflush(stdout);
}

void print_frame_means(const std::vector<FrameRow>& rows) {
    std::vector<std::string> looks;
    for (const FrameRow& row : rows)
        if (std::find(looks.begin(), looks.end(), row.look) == looks.end())
            looks.push_back(row.look);
    std::printf("\na frame in units of the peer's primary rays; geometric means of all scenes and "
                "of levels\n%-11s %7s %7s %7s %7s %7s %7s %7s\n",
                "look", "all", "first", "levels", "first", "hall", "first", "most");
    for (const std::string& look : looks) {
        Summary summary;
        for (const FrameRow& row : rows)
            if (row.look == look) summary.add(row);
        summary.print(look);
    }
}

std::string to_json(const std::vector<FrameRow>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const FrameRow& row : rows)
        list.push_back({{"scene", row.scene},
                        {"look", row.look},
                        {"threads", row.threads},
                        {"size", row.size},
                        {"frame_ms", row.frame_ms},
                        {"first_frame_ms", row.first_frame_ms},
                        {"peer_primary_ms", row.peer_primary_ms},
                        {"ratio", row.ratio()},
                        {"first_ratio", row.first_ratio()},
                        {"rays_primary", std::llround(row.rays_primary)},
                        {"rays_shadow", std::llround(row.rays_shadow)},
                        {"proofs", row.proofs},
                        {"flip_mean", row.flip_mean},
                        {"flip_worst_tile", row.flip_worst_tile},
                        {"triangles", row.triangles},
                        {"peer_mode", row.peer_mode},
                        {"mrays_per_s", row.mrays_per_s},
                        {"mrays_per_s_per_ghz_and_core", row.mrays_per_s_per_ghz_and_core}});
    return list.dump(2);
}

} // namespace peregrine::bench
