#include "render/film.h"

#include "render/post/kernels.h"
#include "render/tile_buffers.h"

namespace peregrine::render {
namespace {

template <class Element>
void store(const Plan& plan, const Tile& tile, const Element* values, Element* plane) {
    store_tile(tile, values, plane, plan.film->stride() * sizeof(Element));
}

// As the eye sees it, more or less.
float brightness(float red, float green, float blue) {
    return 0.25f * red + 0.5f * green + 0.25f * blue;
}

// Names the mesh and the material of each hit.
void find_looks(const scene::Snapshot& snapshot, const TileBuffers& buffers, uint32_t* looks) {
    uint32_t last = geometry::kNoTriangle, look = ~0u;
    for (uint32_t i = 0; i < buffers.tile.count; ++i) {
        const uint32_t triangle = buffers.triangle[i];
        if (triangle != last) {
            last = triangle;
            look = ~0u;
            if (triangle != geometry::kNoTriangle) {
                const geometry::TriangleInfo info = trace::info(snapshot.world, triangle);
                const auto& mesh = snapshot.meshes[info.mesh];
                look = info.mesh * 0x9e3779b1u ^ mesh.materials->of(info.primitive);
            }
        }
        looks[i] = look;
    }
}

uint32_t planes_before_radiance(const Frame& frame) {
    if (!frame.looks_for_edges()) return frame.is_enlarged() ? 3 : 0;
    return frame.shows_particles() ? 8 : 5;
}

} // namespace

Film::Film(const Frame& frame, base::Memory* memory)
    : stride_((frame.traced().width + 2 * kMargin - 1) / kMargin * kMargin),
      plane_size_(stride_ * frame.traced().height + 2 * kMargin),
      radiance_(planes_before_radiance(frame)), floats_(memory), looks_(memory), edges_(memory) {
    floats_.allocate(plane_size_ * (radiance_ + (frame.blooms() ? 3 : 0)));
    if (!frame.looks_for_edges()) return;
    looks_.allocate(plane_size_);
    edges_.allocate(plane_size_);
}

void keep_radiance(const Plan& plan, TileBuffers& buffers) {
    for (int k = 0; k < 3; ++k) {
        float* const radiance = buffers.colors.channel[k];
        for (uint32_t i = 0; i < buffers.tile.count; ++i) radiance[i] = sane_radiance(radiance[i]);
        store(plan, buffers.tile, radiance, plan.film->radiance(k));
    }
}

void keep_shown(const Plan& plan, TileBuffers& buffers) {
    alignas(64) float shown[kTilePadded];
    const post::Kernels& kernels = post::kernels(plan.snapshot.isa());
    for (int k = 0; k < 3; ++k) {
        kernels.to_shown(plan.frame.tone_mapping, plan.frame.exposure, buffers.colors.channel[k],
                         buffers.tile.count, shown);
        store(plan, buffers.tile, shown, plan.film->shown(k));
    }
}

void keep_edges(const Plan& plan, TileBuffers& buffers) {
    alignas(64) float values[kTilePadded];
    alignas(64) uint32_t looks[kTilePadded];
    const Tile& tile = buffers.tile;
    for (uint32_t i = 0; i < tile.count; ++i) values[i] = 1.0f / buffers.t[i];
    store(plan, tile, values, plan.film->nearness());
    const auto& [red, green, blue] = buffers.light->irradiance;
    for (uint32_t i = 0; i < tile.count; ++i) values[i] = brightness(red[i], green[i], blue[i]);
    store(plan, tile, values, plan.film->light());
    find_looks(plan.snapshot, buffers, looks);
    store(plan, tile, looks, plan.film->look());
}

} // namespace peregrine::render
