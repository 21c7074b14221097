#pragma once

#include "base/isa.h"
#include "query/hit_names.h"
#include "trace/kernels.h"

#include <cstddef>
#include <cstdint>

namespace peregrine::query {

// Hits of streams to the host, compiled for each instruction set.
struct HitStores {
    // The host's names of `count` triangles of the world, to places of any alignment; null: not
    // wanted. Neighbours tend to be the same.
    void (*names)(const HitNames& names, const uint32_t* triangles, uint32_t count,
                  uint32_t* primitives, base::Handle* meshes);

    // To records of the host, `stride` bytes apart.
    void (*records)(const HitNames& names, const trace::HitStream& hits, uint32_t count,
                    std::byte* place, uint32_t stride);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const HitStores& hit_stores(base::Isa isa);

} // namespace peregrine::query
