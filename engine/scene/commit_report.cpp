#include "scene/commit.h"

namespace peregrine::scene {
namespace {

template <class T>
uint64_t bytes_of(const base::Vector<T>& vector) {
    return vector.size() * sizeof(T);
}

uint64_t attribute_bytes(const MeshData& data) {
    const MeshSurface& surface = *data.surface;
    return bytes_of(data.positions) + bytes_of(data.normals) + bytes_of(data.tangents)
           + bytes_of(surface.texcoords) + bytes_of(surface.texcoords1)
           + bytes_of(surface.triangles) + bytes_of(surface.materials);
}

uint64_t texture_bytes(const MaterialSet& set) {
    uint64_t bytes = 0;
    for (const auto& texture : set.textures) bytes += bytes_of(texture->texels);
    return bytes;
}

} // namespace

CommitReport Commit::report() {
    CommitReport report;
    report.fixed = snapshot_.fixed;
    report.build = options_.build;
    report.features = snapshot_.features;
    report.bytes_textures = texture_bytes(*snapshot_.material_set);
    report.instance_count = rigid_count_;
    report.light_count = uint32_t(snapshot_.lights->lights.size());
    report.fixed_rebuilt = snapshot_.fixed != scene_.fixed_;
    report.deforming_rebuilt = deforming_built_;
    report.proofs = proof_report_;
    report.degenerate_count = report.fixed->degenerate_count;
    report.non_finite_count = report.fixed->non_finite_count + unusable_;
    for (auto& slot : scene_.meshes.slots())
        if (slot.object) count(*slot.object, report);
    return report;
}

// Instances share everything, and count once.
void Commit::count(const MeshDescription& mesh, CommitReport& report) const {
    if (mesh.shape) {
        if (mesh.shape->counted_by == number_) return;
        mesh.shape->counted_by = number_;
        if (mesh.shape->geometry && !(mesh.hidden && mesh.kind == MeshKind::deforming))
            count(*mesh.shape->geometry, mesh.kind, report);
    }
    const ShownMaterials& shown = mesh.shape ? mesh.shape->shown : mesh.shown;
    report.bytes_attributes += attribute_bytes(*mesh.data) + bytes_of(shown.materials->each);
}

void Commit::count(const Geometry& shape, MeshKind kind, CommitReport& report) const {
    (kind == MeshKind::rigid ? report.rigid_triangles : report.deforming_triangles) +=
        shape.infos.size();
    if (kind == MeshKind::deforming) report.deforming_build_ms += shape.bih.report.build_ms;
    report.shape_bytes += bytes_of(shape.infos) + bytes_of(shape.triangles)
                          + bytes_of(shape.bvh.nodes) + bytes_of(shape.bvh.blocks)
                          + bytes_of(shape.compact_bvh.nodes) + bytes_of(shape.compact_bvh.leaves)
                          + bytes_of(shape.bih.nodes) + bytes_of(shape.bih.references);
    report.degenerate_count += shape.degenerate_count;
    report.non_finite_count += shape.non_finite_count;
}

} // namespace peregrine::scene
