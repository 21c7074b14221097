#pragma once

#include "base/isa.h"
#include "query/records.h"

#include <cstddef>
#include <cstdint>

namespace peregrine::query {

// From the host's rays to streams, compiled for each instruction set. Each says whether all the
// rays that it saw are valid (valid_ray.h).
struct RayLoaders {
    // Records to the eight arrays of a stream, in the order of math::Ray's members. The arrays are
    // padded to a multiple of 16 with the last ray; count > 0.
    bool (*split)(const std::byte* records, uint32_t stride, uint32_t count, float* const lanes[8]);

    // Look, but load nothing.
    bool (*check_records)(const std::byte* records, uint32_t stride, uint64_t count);
    bool (*check_arrays)(const RayArrays& arrays, uint64_t count);
};

// For this instruction set, or the plain one if it was not compiled. Does not ask the machine.
const RayLoaders& ray_loaders(base::Isa isa);

} // namespace peregrine::query
