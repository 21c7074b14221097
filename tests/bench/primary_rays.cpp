#include "primary_rays.h"

#include "render/camera.h"
#include "render/tile.h"

#include <memory>

namespace peregrine::bench {

RaySet make_primary_rays(std::span<const host::Viewpoint> views, uint32_t width, uint32_t height) {
    RaySet set;
    set.batches = {0};
    set.common_origin = true;
    set.views.assign(views.begin(), views.end());
    set.image_width = width;
    set.image_height = height;
    const auto tile = std::make_unique<render::Tile>();
    for (const host::Viewpoint& view : views) {
        const render::Pinhole pinhole({view.vertical_fov, view.position, view.forward, view.up},
                                      width, height);
        const size_t first_pixel = set.rays.size();
        for (uint32_t i = 0; i < render::Tile::tile_count(width, height); ++i) {
            tile->place(i, width, height);
            for (uint32_t k = 0; k < tile->count; ++k) {
                const uint32_t x = tile->x0 + tile->x[k], y = tile->y0 + tile->y[k];
                set.rays.push_back(pinhole.primary(x, y));
                set.pixels.push_back(first_pixel + size_t(y) * width + x);
            }
        }
        set.batches.push_back(set.rays.size());
    }
    return set;
}

} // namespace peregrine::bench
