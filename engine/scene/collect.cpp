#include "scene/collect.h"

#include "geometry/area.h"

namespace peregrine::scene {

uint32_t flags_of(const Material& material) {
    return (material.masked || material.may_pass_light() ? uint32_t(geometry::kMasked) : 0)
           | (material.shows_both_sides() ? 0 : uint32_t(geometry::kSingleSided));
}

void collect_triangles(const MeshData& data, const MeshMaterials& shown,
                       const MaterialSet& materials, uint32_t slot, Geometry& geometry) {
    const size_t before = geometry.triangles.size();
    const auto count = uint32_t(data.triangles().size());
    geometry.triangles.resize(before + count);
    geometry.infos.resize(before + count);
    geometry::Triangle* triangle = geometry.triangles.data() + before;
    geometry::TriangleInfo* info = geometry.infos.data() + before;
    const std::array<uint32_t, 3>* const corners = data.triangles().data();
    const math::Vec3* const positions = data.positions.data();
    uint64_t non_finite = 0, degenerate = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const math::Vec3& v0 = positions[corners[i][0]];
        const math::Vec3& v1 = positions[corners[i][1]];
        const math::Vec3& v2 = positions[corners[i][2]];
        if (!geometry::is_usable(v0) || !geometry::is_usable(v1) || !geometry::is_usable(v2))
            ++non_finite;
        else if (!geometry::has_area(v0, v1, v2))
            ++degenerate;
        else {
            *triangle = {v0, slot, v1, i, v2, flags_of(materials.materials[shown.of(i)])};
            *info++ = triangle++->info();
        }
    }
    geometry.non_finite_count += non_finite;
    geometry.degenerate_count += degenerate;
    geometry.triangles.resize(before + count - non_finite - degenerate);
    geometry.infos.resize(geometry.triangles.size());
}

} // namespace peregrine::scene
