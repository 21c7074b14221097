#include "scene/collect.h"

#include "base/error.h"
#include "geometry/area.h"

namespace peregrine::scene {
namespace {

constexpr uint64_t kMostTriangles = uint64_t(1) << 27;

uint32_t flags_of(const Material& material) {
    return (material.masked ? uint32_t(geometry::kMasked) : 0)
           | (material.double_sided ? 0 : uint32_t(geometry::kSingleSided));
}

uint64_t count_triangles(const Snapshot& snapshot) {
    uint64_t count = 0;
    for (const Snapshot::Mesh& mesh : snapshot.meshes)
        if (mesh.data) count += mesh.data->triangles.size();
    return count;
}

void collect_mesh(const Snapshot& snapshot, uint32_t slot, Geometry& geometry) {
    const Snapshot::Mesh& mesh = snapshot.meshes[slot];
    const MeshData& data = *mesh.data;
    for (uint32_t i = 0; i < data.triangles.size(); ++i) {
        const auto& corners = data.triangles[i];
        const math::Vec3& v0 = data.positions[corners[0]];
        const math::Vec3& v1 = data.positions[corners[1]];
        const math::Vec3& v2 = data.positions[corners[2]];
        if (!geometry::is_usable(v0) || !geometry::is_usable(v1) || !geometry::is_usable(v2))
            ++geometry.non_finite_count;
        else if (!geometry::has_area(v0, v1, v2))
            ++geometry.degenerate_count;
        else {
            geometry.triangles.push_back(
                {v0, slot, v1, i, v2, flags_of(snapshot.materials[mesh.material_of(i)])});
            geometry.infos.push_back(geometry.triangles.back().info());
        }
    }
}

} // namespace

void collect_triangles(const Snapshot& snapshot, Geometry& geometry) {
    const uint64_t count = count_triangles(snapshot);
    if (count > kMostTriangles)
        base::fail(base::Code::limit, "the scene has %llu triangles; at most 2^27 are supported",
                   static_cast<unsigned long long>(count));
    geometry.triangles.reserve(count);
    geometry.infos.reserve(count);
    for (uint32_t slot = 0; slot < snapshot.meshes.size(); ++slot)
        if (snapshot.meshes[slot].data) collect_mesh(snapshot, slot, geometry);
}

} // namespace peregrine::scene
