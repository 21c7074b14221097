#include "render/visibility.h"

#include "query/store_hit.h"
#include "query/surface.h"

#include <cstring>

namespace peregrine::render {
namespace {

template <class Element>
std::byte* place_of(const Plane& plane, const Tile& tile, uint32_t i) {
    return static_cast<std::byte*>(plane.data) + (tile.y0 + tile.y[i]) * plane.row_stride
           + (tile.x0 + tile.x[i]) * sizeof(Element);
}

template <class Element, class Get>
void write_each(const Plane& plane, const Tile& tile, Get&& get) {
    for (uint32_t i = 0; i < tile.count; ++i) {
        const Element element = get(i);
        std::memcpy(place_of<Element>(plane, tile, i), &element, sizeof element);
    }
}

// Rays 2i and 2i + 1 of a whole tile are neighbours in a row.
void write_pairs(const Plane& plane, const Tile& tile, const float* values) {
    for (uint32_t i = 0; i < kTileRays; i += 2)
        std::memcpy(place_of<float>(plane, tile, i), values + i, 2 * sizeof *values);
}

struct Normal {
    float c[3];
};

Normal normal_at(const scene::Snapshot& snapshot, const query::HitNames& names,
                 const TileHits& hits, uint32_t i) {
    if (hits.triangle[i] == geometry::kNoTriangle) return {};
    const query::HitIds ids = names.of(hits.triangle[i]);
    const math::Vec3 n = query::shading_normal(*snapshot.meshes[ids.mesh.index].data, ids.triangle,
                                               hits.u[i], hits.v[i]);
    return {{n.x, n.y, n.z}};
}

} // namespace

void write_planes(const scene::Snapshot& snapshot, const Frame& frame, const Tile& tile,
                  const TileHits& hits) {
    const query::HitNames names(snapshot);
    if (frame.depth.data && tile.count == kTileRays)
        write_pairs(frame.depth, tile, hits.t);
    else if (frame.depth.data)
        write_each<float>(frame.depth, tile, [&](uint32_t i) { return hits.t[i]; });
    if (frame.triangle_ids.data)
        write_each<uint32_t>(frame.triangle_ids, tile,
                             [&](uint32_t i) { return names.of(hits.triangle[i]).triangle; });
    if (frame.mesh_ids.data)
        write_each<base::Handle>(frame.mesh_ids, tile,
                                 [&](uint32_t i) { return names.of(hits.triangle[i]).mesh; });
    if (frame.normals.data)
        write_each<Normal>(frame.normals, tile,
                           [&](uint32_t i) { return normal_at(snapshot, names, hits, i); });
}

} // namespace peregrine::render
