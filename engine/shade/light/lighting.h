#pragma once

#include "scene/snapshot.h"
#include "shade/kernels.h"
#include "shade/light/choice.h"
#include "shade/light/marks.h"
#include "shade/light/shadows.h"
#include "shade/light/tints.h"
#include "shade/scratch.h"

#include <optional>
#include <span>

namespace peregrine::shade {

// All the light of a frame. Read-only: all threads share it.
class Lighting {
public:
    // `lights`, `unseen`: as of LightChoice; they and surfaces are relative to `space.origin`.
    Lighting(const scene::Snapshot& snapshot, std::span<const PreparedLight> lights,
             const SurfaceSpace& space, Program program, bool shadows, float unseen);

    // From here on, light is tinted by what it passes: see Tints. Threads then need scratch.tints.
    void tint() {
        if (!traces_shadows_) return;
        tints_.emplace(*snapshot_, space_);
        shadows_.see_opaque_alone();
    }
    bool tints() const { return tints_.has_value(); }

    std::span<const PreparedLight> lights() const { return lights_; }
    const LightChoice& choice() const { return choice_; }

    // What arrives at the points of scratch.surface, in scratch.light. `marks`: null, or filled
    // with who sees whom; rays are not traced for what is known there.
    void gather(const RayHits& hits, Scratch& scratch, BatchMarks* marks) const;

private:
    struct Task {
        const PreparedLight& light;
        uint32_t slot; // in marks
        const RayHits& hits;
        Scratch& scratch;
        BatchMarks* marks;
    };
    struct Known {
        Recalled recalled;
        bool some_are_lit = false;
        bool all_are_hidden = false;
    };

    void illuminate(const Task& task) const;
    Known find_known(const Task& task) const;
    void mark(const Task& task, const Known& known, uint32_t ray_count) const;

    const scene::Snapshot* snapshot_;
    const Kernels* kernels_;
    std::span<const PreparedLight> lights_;
    SurfaceSpace space_;
    LightChoice choice_;
    Shadows shadows_;
    std::optional<Tints> tints_;
    Program program_;
    bool traces_shadows_;
    bool recalls_;
};

} // namespace peregrine::shade
