#include "frame_look.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace peregrine::bench {
namespace {

constexpr const char* kNames[] = {"visibility", "direct", "exact"};

} // namespace

std::vector<std::string> look_names() {
    return {std::begin(kNames), std::end(kNames)};
}

Look look_of(const std::string& name) {
    const auto place = std::find(std::begin(kNames), std::end(kNames), name);
    if (place == std::end(kNames)) throw std::runtime_error("unknown look: " + name);
    return Look(place - std::begin(kNames));
}

const char* name_of(Look look) {
    return kNames[int(look)];
}

FrameMemory::FrameMemory(uint32_t w, uint32_t h)
    : width(w), height(h), pixels(size_t(w) * h * 4), depth(size_t(w) * h),
      triangles(size_t(w) * h), meshes(size_t(w) * h) {}

rt_frame_desc describe_frame(Look look, FrameMemory& memory) {
    rt_frame_desc frame = rt_default_frame_desc();
    frame.width = memory.width;
    frame.height = memory.height;
    if (look == Look::visibility) {
        frame.depth = memory.depth.data();
        frame.triangle_ids = memory.triangles.data();
        frame.mesh_ids = memory.meshes.data();
        return frame;
    }
    frame.pixels = memory.pixels.data();
    // A frame has no option yet that approximates: `exact` would have them all off here.
    return frame;
}

rt_commit_desc describe_commit(Look) {
    return rt_default_commit_desc();
}

uint64_t count_proofs(const rt_frame_stats&, const rt_commit_report&) {
    return 0; // nothing is proved for patches yet
}

} // namespace peregrine::bench
