#pragma once

#include <peregrine/rt.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace peregrine::test {

// What a frame is asked for.
enum class Look {
    visibility, // depth and ids, no pixels
    direct,     // shaded, as rt_default_frame_desc() and rt_default_commit_desc() have it
    exact,      // shaded, without any approximation
};
inline constexpr const char* kLookNames[] = {"visibility", "direct", "exact"};

inline const char* name_of(Look look) {
    return kLookNames[int(look)];
}

// Throws for what is no look's name.
inline Look look_of(const std::string& name) {
    const auto place = std::find(std::begin(kLookNames), std::end(kLookNames), name);
    if (place == std::end(kLookNames)) throw std::runtime_error("unknown look: " + name);
    return Look(place - std::begin(kLookNames));
}

// The one place that knows by which options looks differ: those of a frame, and where it is told
// how many answers for whole patches a commit has tried to prove.
inline void set_options(Look look, rt_frame_desc& frame) {
    if (look != Look::exact) return;
    frame.light_block = frame.airlight_block = 1;
    frame.texture_filter = RT_TEXTURE_FINEST;
    frame.least_light = 0;
    frame.edge_samples = 1;
    frame.tinted_shadows = 0;
    frame.baked_light = 0;
    frame.render_width = frame.render_height = 0;
}
inline uint64_t count_proofs(const rt_commit_report& report) {
    return report.proof_count;
}

// Where frames of all looks go.
struct FrameMemory {
    FrameMemory(uint32_t w, uint32_t h)
        : width(w), height(h), pixels(size_t(w) * h * 4), depth(size_t(w) * h),
          triangles(size_t(w) * h), meshes(size_t(w) * h) {}

    rt_frame_desc frame(Look look) {
        rt_frame_desc frame = rt_default_frame_desc();
        frame.width = width;
        frame.height = height;
        set_options(look, frame);
        if (look == Look::visibility) {
            frame.depth = depth.data();
            frame.triangle_ids = triangles.data();
            frame.mesh_ids = meshes.data();
        } else {
            frame.pixels = pixels.data();
        }
        return frame;
    }

    uint32_t width, height;
    std::vector<uint8_t> pixels; // RGBA, sRGB
    std::vector<float> depth;
    std::vector<uint32_t> triangles;
    std::vector<rt_mesh> meshes;
};

} // namespace peregrine::test
