#pragma once

#include "accel/buffer.h"
#include "render/frame.h"
#include "render/plan.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace peregrine::render {

// What is known of all pixels that a frame traced, for passes that look at neighbours. Planes have
// rows of stride() elements; the kernels may touch kMargin elements beyond both ends of any row.
class Film {
public:
    static constexpr uint32_t kMargin = 16;

    Film(const Frame& frame, base::Memory* memory);
    static bool is_needed(const Frame& frame) {
        return frame.looks_for_edges() || frame.is_enlarged() || frame.blooms();
    }

    size_t stride() const { return stride_; }

    // At the first pixel. Of frames that bloom, sane_radiance(); ...
    float* radiance(int channel) { return floats(radiance_ + uint32_t(channel)); }
    const float* radiance(int channel) const { return floats(radiance_ + uint32_t(channel)); }
    // ... of those with edges or that are enlarged, colours as post/shown.h has them; ...
    float* shown(int channel) { return floats(uint32_t(channel)); }
    const float* shown(int channel) const { return floats(uint32_t(channel)); }
    // ... and of a film for edges: 1 / depth, ...
    float* nearness() { return floats(3); }
    float* light() { return floats(4); }                                    // how much arrives, ...
    float* particles(int channel) { return floats(5 + uint32_t(channel)); } // their light, ...
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
    uint32_t radiance_; // the first plane of it
    accel::Buffer<float> floats_;
    accel::Buffer<uint32_t> looks_;
    accel::Buffer<uint16_t> edges_;
};

// Of which sums are finite. Not a number: 0.
inline float sane_radiance(float radiance) {
    return radiance > 0.0f ? std::min(radiance, 1e12f) : 0.0f;
}

// Stages that put on the plan's film: the tile's radiance, ...
void keep_radiance(const Plan& plan, TileBuffers& buffers);
// ... as it will be shown, ...
void keep_shown(const Plan& plan, TileBuffers& buffers);
// ... and what edges follow from.
void keep_edges(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
