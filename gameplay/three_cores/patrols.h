#pragma once

#include "gameplay/three_cores/floors.h"

namespace peregrine::three_cores {

// Rounds for drones, all over the floors and away from the spawn: two to four points each, above
// places of the graph, with free flight between them. Fewer in small levels; perhaps none.
std::vector<std::vector<Vec3>> plan_patrols(const gameplay::World& world, const Floors& floors,
                                            const Vec3& spawn);

} // namespace peregrine::three_cores
