#pragma once

#include "support/world.h"

#include <peregrine/rt.h>
#include <string>
#include <vector>

namespace peregrine::bench {

// What moving meshes cost rays of a level that miss them.
struct RayCost {
    std::string what; // moves
    std::string rays; // kind
    const char* asked;
    double ns_without, ns_with; // medians, a ray
    double ratio;               // median of those of rounds
};

std::vector<RayCost> measure_rays(const rt_api& api, const test::SceneFile& level, uint32_t passes);

} // namespace peregrine::bench
