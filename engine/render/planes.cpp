#include "render/planes.h"

#include "query/hit_stores.h"
#include "query/surface.h"

namespace peregrine::render {
namespace {

template <class Element>
void write(const Plane& plane, const Tile& tile, const Element* values) {
    store_tile(tile, values, plane.data, plane.row_stride);
}

constexpr size_t kLine = 64; // of a cache, bytes

// The lines of a tile's rows. Always inline: GCC drops calls of functions that prefetch and no
// more.
__attribute__((always_inline)) inline void fetch(const Plane& plane, size_t pixel_size,
                                                 const Tile& tile) {
    if (!plane.data) return;
    const auto* row = static_cast<const std::byte*>(plane.data) + tile.y0 * plane.row_stride
                      + tile.x0 * pixel_size;
    for (uint32_t y = 0; y < tile.height(); ++y, row += plane.row_stride)
        for (size_t at = 0; at < tile.width() * pixel_size; at += kLine)
            __builtin_prefetch(row + at, 1, 2);
}

struct Normal {
    float c[3];
};

struct TileNormals {
    Normal normal[kTileRays];

    // Neighbours often see the same triangle; a flat one has the same normal for all of them.
    TileNormals(const scene::Snapshot& snapshot, const TileBuffers& hits, uint32_t count) {
        uint32_t flat = geometry::kNoTriangle;
        Normal flat_normal = {};
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t triangle = hits.triangle[i];
            if (triangle == geometry::kNoTriangle) {
                normal[i] = {};
            } else if (triangle == flat) {
                normal[i] = flat_normal;
            } else {
                const geometry::TriangleInfo info = trace::info(snapshot.world, triangle);
                const query::PlacedMesh mesh(snapshot, snapshot.meshes[info.mesh]);
                const math::Vec3 n = mesh.shading_normal(info.primitive, hits.u[i], hits.v[i]);
                normal[i] = {{n.x, n.y, n.z}};
                if (!mesh.is_flat()) continue;
                flat = triangle;
                flat_normal = normal[i];
            }
        }
    }
};

} // namespace

void fetch_planes(const Plan& plan, TileBuffers& buffers) {
    const Frame& frame = plan.frame;
    const Tile& tile = buffers.tile;
    fetch(frame.depth, sizeof(float), tile);
    fetch(frame.triangle_ids, sizeof(uint32_t), tile);
    fetch(frame.mesh_ids, sizeof(base::Handle), tile);
    fetch(frame.normals, sizeof(Normal), tile);
}

void write_planes(const Plan& plan, TileBuffers& buffers) {
    const Frame& frame = plan.frame;
    const Tile& tile = buffers.tile;
    if (frame.depth.data) write(frame.depth, tile, buffers.t);
    if (frame.triangle_ids.data || frame.mesh_ids.data) {
        query::hit_stores(plan.snapshot.isa())
            .names(query::HitNames(plan.snapshot), buffers.triangle, tile.count,
                   buffers.triangle_id, buffers.mesh_id);
        if (frame.triangle_ids.data) write(frame.triangle_ids, tile, buffers.triangle_id);
        if (frame.mesh_ids.data) write(frame.mesh_ids, tile, buffers.mesh_id);
    }
    if (frame.normals.data)
        write(frame.normals, tile, TileNormals(plan.snapshot, buffers, tile.count).normal);
}

} // namespace peregrine::render
