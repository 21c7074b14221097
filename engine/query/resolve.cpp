#include "query/resolve.h"

#include "base/error.h"
#include "query/marks.h"
#include "query/surface.h"

#include <cmath>
#include <limits>

namespace peregrine::query {
namespace {

bool is_miss(const Hit& hit) {
    return hit.triangle == geometry::kNoTriangle && !hit.mesh;
}

bool has_mesh(const scene::Snapshot& snapshot, const base::Handle& mesh) {
    return mesh.index < snapshot.meshes.size() && snapshot.meshes[mesh.index].data
           && snapshot.meshes[mesh.index].generation == mesh.generation;
}

size_t triangle_count(const scene::Snapshot& snapshot, const base::Handle& mesh) {
    return snapshot.meshes[mesh.index].data->triangles().size();
}

bool is_valid(const scene::Snapshot& snapshot, const Hit& hit) {
    return is_miss(hit)
           || (has_mesh(snapshot, hit.mesh) && hit.triangle < triangle_count(snapshot, hit.mesh)
               && std::isfinite(hit.u) && std::isfinite(hit.v));
}

void check(const scene::Snapshot& snapshot, const Hit& hit, uint64_t index) {
    if (is_valid(snapshot, hit)) return;
    const auto place = static_cast<unsigned long long>(index);
    if (!has_mesh(snapshot, hit.mesh))
        base::fail(base::Code::invalid_handle, "hit %llu: the snapshot has no mesh {%u, %u}", place,
                   hit.mesh.index, hit.mesh.generation);
    const size_t count = triangle_count(snapshot, hit.mesh);
    if (hit.triangle >= count)
        base::fail(base::Code::invalid_argument,
                   "hit %llu: triangle %u, but the mesh has %zu triangles", place, hit.triangle,
                   count);
    base::fail(base::Code::invalid_argument, "hit %llu: the barycentrics are not finite", place);
}

math::Vec2 texcoord_at(const scene::MeshData& mesh, const Hit& hit) {
    if (mesh.surface->texcoords.empty()) return math::Vec2(0);
    return math::Vec2(
        blend<glm::dvec2>(mesh.surface->texcoords, mesh.triangles()[hit.triangle], hit.u, hit.v));
}

} // namespace

Surface surface_at(const scene::Snapshot& snapshot, const Hit& hit, uint32_t fields,
                   const math::Vec3d& origin) {
    Surface surface;
    if (is_miss(hit)) return surface;
    const scene::Snapshot::Mesh& mesh = snapshot.meshes[hit.mesh.index];
    const PlacedMesh placed(snapshot, mesh);
    if (fields & kPosition)
        surface.position = (snapshot.origin - origin) + placed.position(hit.triangle, hit.u, hit.v);
    if (fields & kGeometricNormal) surface.geometric_normal = placed.geometric_normal(hit.triangle);
    if (fields & kShadingNormal)
        surface.shading_normal = placed.shading_normal(hit.triangle, hit.u, hit.v);
    if (fields & kTexcoord) surface.texcoord = texcoord_at(*mesh.data, hit);
    if (fields & (kMaterial | kUserData)) {
        const scene::Material& material = snapshot.material_of(mesh, hit.triangle);
        if (fields & kMaterial) surface.material = {material.slot, material.generation};
        if (fields & kUserData) surface.material_user_data = material.user_data;
    }
    if (fields & kUserData) surface.mesh_user_data = mesh.user_data;
    return surface;
}

void resolve(const scene::Snapshot& snapshot, const Strided<Hit>& hits, const Surfaces& surfaces,
             const math::Vec3d& origin, bool mark_invalid) {
    if (!mark_invalid)
        for (uint64_t i = 0; i < hits.count; ++i) check(snapshot, hits.load(i), i);
    for (uint64_t i = 0; i < hits.count; ++i) {
        const Hit hit = hits.load(i);
        const bool is_marked = mark_invalid && !is_valid(snapshot, hit);
        surfaces.store(i, is_marked ? invalid_surface()
                                    : surface_at(snapshot, hit, surfaces.fields, origin));
    }
}

} // namespace peregrine::query
