#pragma once

#include <peregrine/rt.h>

#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::bench {

// What a frame is asked for.
enum class Look {
    visibility, // depth and ids, no pixels
    direct,     // shaded, as rt_default_frame_desc() has it
    exact,      // shaded, without any approximation
};

std::vector<std::string> look_names();
Look look_of(const std::string& name); // throws for any other name
const char* name_of(Look look);

// Where frames of all looks go.
struct FrameMemory {
    FrameMemory(uint32_t width, uint32_t height);

    uint32_t width, height;
    std::vector<uint8_t> pixels; // RGBA, sRGB
    std::vector<float> depth;
    std::vector<uint32_t> triangles;
    std::vector<rt_mesh> meshes;
};

// The one place that knows by which options looks differ.
rt_frame_desc describe_frame(Look look, FrameMemory& memory);
rt_commit_desc describe_commit(Look look);

// How many answers for whole patches a frame and the commit before it proved.
uint64_t count_proofs(const rt_frame_stats& frame, const rt_commit_report& commit);

} // namespace peregrine::bench
