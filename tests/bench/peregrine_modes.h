#pragma once

#include "tracer.h"

#include <span>

namespace peregrine::bench {

// A call of the engine and what surrounds it.
struct DoorJob {
    const rt_api& api;
    rt_scene scene;
    const RaySet& set;
    size_t first, count;
    Results& results;

    void require(rt_result result) const; // throws the engine's sentence
};

// A way to have rays traced through the header.
struct DoorMode {
    const char* name;
    bool (*suits)(const RaySet&);
    void (*trace)(const DoorJob&);
    Answer (*answer)(const RaySet&, const Results&, size_t ray);
    bool parallel = false; // the engine spreads the work over its own threads
};

// The first suits all sets.
std::span<const DoorMode> door_modes();

} // namespace peregrine::bench
