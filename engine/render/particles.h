#pragma once

#include "accel/buffer.h"
#include "render/post/kernels.h"
#include "render/tile_buffers.h"

#include <cstdint>

namespace peregrine::render {

struct Plan;

// A frame's particles as they are on its picture, in their order: that of the sums of light. A tile
// looks for its own by boxes around groups of them, so that their memory is so much a particle,
// however large they are.
class Particles {
public:
    static constexpr uint32_t kShare = 1024; // found at a time

    Particles(const Frame& frame, base::Memory* memory);

    uint32_t share_count() const { return (count_ + kShare - 1) / kShare; }
    // Finds where the particles of a share are, and which of them are seen.
    void find(const Plan& plan, uint32_t share, TileBuffers& buffers);

    // Calls draw(sprite, area) for what is within the tile, in order. The area is the tile's.
    template <class Draw>
    void for_each_in(const Tile& tile, Draw&& draw) const {
        const Box whole = {uint16_t(tile.x0), uint16_t(tile.y0), uint16_t(tile.x0 + tile.width()),
                           uint16_t(tile.y0 + tile.height())};
        for (uint32_t first = 0; first < count_; first += kGroup) {
            if (!groups_[first / kGroup].meets(whole)) continue;
            const uint32_t end = std::min(first + kGroup, count_);
            for (uint32_t i = first; i < end; ++i)
                if (boxes_[i].meets(whole)) draw(sprites_[i], boxes_[i].within(whole));
        }
    }

private:
    static constexpr uint32_t kGroup = 64;
    static_assert(kShare % kGroup == 0 && kShare <= kTileRays);

    // Of pixels; `left` and `top` are within, the others are not.
    struct Box {
        uint16_t left = 0xffff, top = 0xffff, right = 0, bottom = 0; // empty

        bool meets(const Box& other) const {
            return left < other.right && other.left < right && top < other.bottom
                   && other.top < bottom;
        }
        void extend(const Box& other) {
            left = std::min(left, other.left);
            top = std::min(top, other.top);
            right = std::max(right, other.right);
            bottom = std::max(bottom, other.bottom);
        }
        post::SpriteArea within(const Box& tile) const {
            const auto from = [](uint16_t at, uint16_t begin) {
                return uint32_t(at > begin ? at - begin : 0);
            };
            return {tile.left,
                    tile.top,
                    from(left, tile.left),
                    from(top, tile.top),
                    from(std::min(right, tile.right), tile.left),
                    from(std::min(bottom, tile.bottom), tile.top)};
        }
    };

    class View; // particles.cpp

    // Of those that are on the picture.
    void look_at(const Plan& plan, const uint32_t* index, uint32_t count, TileBuffers& buffers);
    void dim(const Plan& plan, const uint32_t* index, uint32_t count, TileBuffers& buffers);

    uint32_t count_;
    accel::Buffer<post::Sprite> sprites_;
    accel::Buffer<Box> boxes_;
    accel::Buffer<Box> groups_;
};

// A stage: adds the light of the particles that are before what the tile's rays hit.
void add_particles(const Plan& plan, TileBuffers& buffers);

} // namespace peregrine::render
