#pragma once

#include <cstdint>
#include <vector>

#include "level.h"

namespace host {

// Lamps in the place of what glows: the engine shows emissive triangles, but they light nothing.
struct EmissiveLamps {
    std::vector<Light> lights;
    double power = 0.0;    // of all that glows, the mean of red, green and blue; and the part ...
    double left_out = 0.0; // ... of patches that got no lamp
};

// At most `most`, the strongest ones, for the meshes that stand still. Patches that hang together
// are cut by the way they face, then by size, until pieces are rather flat and round. A piece of
// radiance L and area A becomes a spot of L A candela over all of the half sphere before it, which
// has the piece's power, pi L A, to the last digit; docs/gltf.md has the error.
EmissiveLamps find_emissive_lamps(const Level& level, uint32_t most);

} // namespace host
