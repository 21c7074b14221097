#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace peregrine::bench {

// What was measured of a scene and a look; the mean of its cameras. NaN: not measured.
struct FrameRow {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::string scene, look;
    size_t triangles = 0;
    uint32_t threads = 1;
    std::string size;
    double frame_ms = kNone, first_frame_ms = kNone;
    std::string peer_mode;
    double peer_primary_ms = kNone;
    double rays_primary = 0, rays_shadow = 0;
    uint64_t proofs = 0;
    double flip_mean = kNone, flip_worst_tile = kNone;
    double mrays_per_s = kNone, mrays_per_s_per_ghz_and_core = kNone;

    double ratio() const { return frame_ms / peer_primary_ms; }
    double first_ratio() const { return first_frame_ms / peer_primary_ms; }
};

void print_frame_header();
void print_frame_row(const FrameRow& row);
void print_frame_means(const std::vector<FrameRow>& rows); // geometric, of ratios
std::string to_json(const std::vector<FrameRow>& rows);

} // namespace peregrine::bench
