#include "render/planes.h"

#include "query/hit_stores.h"
#include "query/surface.h"

namespace peregrine::render {
namespace {

template <class Element>
void write(const Plane& plane, const Tile& tile, const Element* values) {
    store_tile(tile, values, plane.data, plane.row_stride);
}

struct TileIds {
    uint32_t triangle[kTileRays];
    base::Handle mesh[kTileRays];

    TileIds(const scene::Snapshot& snapshot, const uint32_t* triangles, uint32_t count) {
        query::hit_stores(snapshot.isa())
            .names(query::HitNames(snapshot), triangles, count, triangle, mesh);
    }
};

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

void write_planes(const Plan& plan, TileBuffers& buffers) {
    const Frame& frame = plan.frame;
    const Tile& tile = buffers.tile;
    if (frame.depth.data) write(frame.depth, tile, buffers.t);
    if (frame.triangle_ids.data || frame.mesh_ids.data) {
        const TileIds ids(plan.snapshot, buffers.triangle, tile.count);
        if (frame.triangle_ids.data) write(frame.triangle_ids, tile, ids.triangle);
        if (frame.mesh_ids.data) write(frame.mesh_ids, tile, ids.mesh);
    }
    if (frame.normals.data)
        write(frame.normals, tile, TileNormals(plan.snapshot, buffers, tile.count).normal);
}

} // namespace peregrine::render
