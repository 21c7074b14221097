#include "scene/collect.h"

#include "geometry/area.h"

namespace peregrine::scene {
namespace {

uint32_t flags_of(const Material& material) {
    return (material.masked ? uint32_t(geometry::kMasked) : 0)
           | (material.double_sided ? 0 : uint32_t(geometry::kSingleSided));
}

} // namespace

void collect_triangles(const MeshData& data, const MeshMaterials& shown,
                       const MaterialSet& materials, uint32_t slot, Geometry& geometry) {
    for (uint32_t i = 0; i < data.triangles().size(); ++i) {
        const auto& corners = data.triangles()[i];
        const math::Vec3& v0 = data.positions[corners[0]];
        const math::Vec3& v1 = data.positions[corners[1]];
        const math::Vec3& v2 = data.positions[corners[2]];
        if (!geometry::is_usable(v0) || !geometry::is_usable(v1) || !geometry::is_usable(v2))
            ++geometry.non_finite_count;
        else if (!geometry::has_area(v0, v1, v2))
            ++geometry.degenerate_count;
        else {
            geometry.triangles.push_back(
                {v0, slot, v1, i, v2, flags_of(materials.materials[shown.of(i)])});
            geometry.infos.push_back(geometry.triangles.back().info());
        }
    }
}

} // namespace peregrine::scene
