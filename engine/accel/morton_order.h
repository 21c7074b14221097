#pragma once

#include "accel/buffer.h"
#include "accel/reference.h"

#include <span>

namespace peregrine::accel {

// A place on the Morton curve through a cube: bit 3 k + a belongs to axis a.
struct MortonKey {
    uint32_t place;
    uint32_t item; // a triangle or point
};

inline constexpr uint32_t kMaxMortonBits = 10; // an axis

// The triangles in ascending order along the curve through their centres, stably.
Buffer<MortonKey> sort_along_morton_curve(std::span<const geometry::Triangle> triangles,
                                          const Bounds& centers, uint32_t bits_an_axis,
                                          base::Scheduler& scheduler, base::Memory* memory);

// ... points, which lie in `bounds`.
Buffer<MortonKey> sort_along_morton_curve(std::span<const math::Vec3> points,
                                          const math::Box& bounds, uint32_t bits_an_axis,
                                          base::Scheduler& scheduler, base::Memory* memory);

} // namespace peregrine::accel
