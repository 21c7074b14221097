#pragma once

#include "scene/geometry.h"
#include "scene/light.h"
#include "trace/visibility/point_visibility.h"
#include "trace/visibility/shaft.h"

#include <cstdint>
#include <memory>

namespace peregrine::scene {

// Whether and how commits prove which fixed triangles see which lights. It changes the speed of
// frames, not a bit of them.
struct ProofChoice {
    bool proves = false;                      // else only what was proved before is kept
    uint64_t most_bytes = uint64_t(64) << 20; // of all that is remembered
    float patch_size = 1;                     // metres: smaller patches are not cut any more
    float budget_ms = 0;                      // of a commit; 0: no bound
};

// What was proved of a light, and what it was proved for.
struct LightView {
    std::shared_ptr<const trace::visibility::PointVisibility> view; // null: nothing
    std::shared_ptr<const Geometry> geometry;
    trace::visibility::Lamp lamp{};
    uint32_t generation = 0; // of the light's slot; 0: there is none

    // Whether it holds for this light, too.
    bool holds_for(const trace::visibility::Lamp& other, uint32_t generation_of,
                   const std::shared_ptr<const Geometry>& fixed) const {
        return generation == generation_of && geometry == fixed && lamp.is_far == other.is_far
               && lamp.position == other.position && lamp.direction == other.direction
               && lamp.reach >= other.reach;
    }
};

struct ProofReport {
    uint32_t lights = 0;  // of which something is remembered
    uint32_t waiting = 0; // whose proofs have not ended
    uint64_t proofs = 0;  // tried by this commit
    uint64_t bytes = 0;   // remembered
    double ms = 0;        // wall time of this commit's proofs
};

trace::visibility::Lamp lamp_of(const Light& light);

} // namespace peregrine::scene
