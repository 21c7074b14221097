#pragma once

#include "accel/buffer.h"
#include "render/frame.h"
#include "render/plan.h"

#include <cstddef>
#include <cstdint>

namespace peregrine::render {

// What is known of all pixels that a frame traced, for passes that look at neighbours. Planes have
// rows of stride() elements; the kernels may touch kMargin elements beyond both ends of any row.
class Film {
public:
    static constexpr uint32_t kMargin = 16;

    Film(const Extent& extent, bool edges, base::Memory* memory);

    size_t stride() const { return stride_; }
    bool has_edges() const { return has_edges_; }

    // At the first pixel. Colours as post/shown.h has them ...
    float* shown(int channel) { return floats(uint32_t(channel)); }
    const float* shown(int channel) const { return floats(uint32_t(channel)); }
    // ... and of a film for edges: 1 / depth, ...
    float* nearness() { return floats(3); }
    float* light() { return floats(4); } // how much arrives, ...
    // ... names of what is seen, ...
    uint32_t* look() { return looks_.data() + kMargin; }
    // ... and how much each pixel is one: see post/edges.h.
    uint16_t* edge() { return edges_.data() + kMargin; }

private:
    float* floats(uint32_t plane) { return floats_.data() + plane * plane_size_ + kMargin; }
    const float* floats(uint32_t plane) const {
        return floats_.data() + plane * plane_size_ + kMargin;
    }

    size_t stride_;
    size_t plane_size_;
    bool has_edges_;
    accel::Buffer<float> floats_;
    accel::Buffer<uint32_t> looks_;
    accel::Buffer<uint16_t> edges_;
};

// A stage: puts the tile's radiance, and what was hit, on the plan's film.
void keep_on_film(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
