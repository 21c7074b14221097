#include "query/resolve.h"

#include "base/error.h"

#include <cmath>
#include <limits>

namespace peregrine::query {
namespace {

bool is_miss(const Hit& hit) {
    return hit.triangle == geometry::kNoTriangle && !hit.mesh;
}

void check(const scene::Snapshot& snapshot, const Hit& hit, uint64_t index) {
    if (is_miss(hit)) return;
    const auto place = static_cast<unsigned long long>(index);
    if (hit.mesh.index >= snapshot.meshes.size() || !snapshot.meshes[hit.mesh.index].data
        || snapshot.meshes[hit.mesh.index].generation != hit.mesh.generation)
        base::fail(base::Code::invalid_handle,
                   "hit %llu: the current snapshot has no mesh {%u, %u}", place, hit.mesh.index,
                   hit.mesh.generation);
    const size_t count = snapshot.meshes[hit.mesh.index].data->triangles.size();
    if (hit.triangle >= count)
        base::fail(base::Code::invalid_argument,
                   "hit %llu: triangle %u, but the mesh has %zu triangles", place, hit.triangle,
                   count);
    if (!std::isfinite(hit.u) || !std::isfinite(hit.v))
        base::fail(base::Code::invalid_argument, "hit %llu: the barycentrics are not finite",
                   place);
}

// In double: the sides of a triangle may be 1e30.
math::Vec3d unit(const math::Vec3d& v) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > 0 ? v / length : math::Vec3d(0);
}

Surface surface_at(const scene::Snapshot& snapshot, const Hit& hit) {
    if (is_miss(hit)) return {};
    const scene::Snapshot::Mesh& mesh = snapshot.meshes[hit.mesh.index];
    const scene::MeshData& data = *mesh.data;
    const auto& corners = data.triangles[hit.triangle];
    const double weights[3] = {1.0 - double(hit.u) - double(hit.v), double(hit.u), double(hit.v)};
    const auto blend = [&](const auto& values, auto zero) {
        for (size_t k = 0; k < 3; ++k) zero += weights[k] * decltype(zero)(values[corners[k]]);
        return zero;
    };
    const math::Vec3d v0 = data.positions[corners[0]];
    const math::Vec3d v1 = data.positions[corners[1]];
    const math::Vec3d v2 = data.positions[corners[2]];
    const scene::Material& material = snapshot.materials[mesh.material_of(hit.triangle)];

    Surface surface;
    surface.position = weights[0] * v0 + weights[1] * v1 + weights[2] * v2;
    const math::Vec3d normal = unit(glm::cross(v1 - v0, v2 - v0));
    surface.geometric_normal = math::Vec3(normal);
    surface.shading_normal = surface.geometric_normal;
    if (!data.normals.empty()) {
        const math::Vec3d shading = unit(blend(data.normals, math::Vec3d(0)));
        if (shading != math::Vec3d(0)) surface.shading_normal = math::Vec3(shading);
    }
    if (!data.texcoords.empty())
        surface.texcoord = math::Vec2(blend(data.texcoords, glm::dvec2(0)));
    surface.material = {material.slot, material.generation};
    surface.material_user_data = material.user_data;
    surface.mesh_user_data = mesh.user_data;
    return surface;
}

} // namespace

void resolve(const scene::Snapshot& snapshot, const Strided<Hit>& hits,
             const Strided<Surface>& surfaces) {
    for (uint64_t i = 0; i < hits.count; ++i) check(snapshot, hits.load(i), i);
    for (uint64_t i = 0; i < hits.count; ++i) surfaces.store(i, surface_at(snapshot, hits.load(i)));
}

} // namespace peregrine::query
