#pragma once

#include "render/camera.h"
#include "render/frame.h"
#include "shade/air/airlight.h"
#include "shade/air/fog.h"
#include "shade/blocks/block_light.h"
#include "shade/occlusion/block_openness.h"
#include "shade/path/paths.h"
#include "shade/shader.h"
#include "trace/filter.h"

#include <array>
#include <cstdint>
#include <span>

namespace peregrine::render {

class Film;
class Particles;
namespace post {
class Bloom;
}
struct Plan;
struct TileBuffers;

// A step of each tile's way from rays to pixels.
using Stage = void (*)(const Plan& plan, TileBuffers& buffers);

// How a frame is made: the stages that it needs, in order, and what they share. Read-only.
struct Plan {
    const scene::Snapshot& snapshot;
    const Frame& frame;
    Extent extent;              // in pixels that are traced
    Film* film;                 // null: no pass looks at neighbours
    const post::Bloom* bloom;   // null: no light spreads
    const Particles* particles; // null: there are none
    Pinhole pinhole;
    math::Vec3d eye;      // where its rays begin
    trace::Filter filter; // of primary rays
    shade::Shader shader;
    shade::BlockLight block_light;       // of frames with light in blocks
    shade::BlockOpenness block_openness; // if the shader finds it
    shade::Fog fog;
    shade::Airlight airlight;
    shade::Paths paths; // of scenes with mirrors or glass

    // All must outlive the plan; `moved_lights`: room for lights that are relative to the eye.
    // `film`, `bloom` and `particles` are for the frames that need them.
    Plan(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
         base::Vector<shade::PreparedLight>& moved_lights, Film* film,
         const post::Bloom* bloom = nullptr, const Particles* particles = nullptr);
    Plan(const Plan&) = delete; // its parts refer to each other

    std::span<const Stage> stages() const { return stages_.list(); }
    // What is left to do to each tile when the light of all of them has spread.
    std::span<const Stage> later_stages() const { return later_stages_.list(); }

private:
    class Stages {
    public:
        void add(Stage stage) {
            if (stage) stages_[count_++] = stage;
        }
        std::span<const Stage> list() const { return {stages_.data(), count_}; }

    private:
        static constexpr uint32_t kMost = 14;

        std::array<Stage, kMost> stages_{};
        uint32_t count_ = 0;
    };

    void finish(Stages& stages) const; // from radiance on

    Stages stages_, later_stages_;
};

} // namespace peregrine::render
