#include "standing_triangles.h"

#include "animation/pose.h"
#include "animation/skinning.h"
#include "support/world.h"

#include <span>
#include <utility>

namespace peregrine::bench {
namespace {

void add(std::span<const uint32_t> indices, std::span<const math::Vec3> positions,
         test::TriangleList& list) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        list.add(positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]);
}

} // namespace

std::vector<geometry::Triangle> standing_triangles(const host::Level& level) {
    test::TriangleList list;
    for (const host::Mesh& mesh : level.meshes) add(mesh.indices, mesh.positions, list);
    host::Pose pose(level.rig);
    pose.set(0);
    std::vector<math::Vec3> positions;
    for (const host::RigidMesh& rigid : level.rigid_meshes)
        for (const uint32_t node : rigid.nodes) {
            positions.clear();
            for (const math::Vec3& position : rigid.mesh.positions)
                positions.emplace_back(pose.world(node) * glm::dvec4(position, 1));
            add(rigid.mesh.indices, positions, list);
        }
    std::vector<glm::mat4x3> joints;
    host::Shape shape;
    for (const host::DeformingMesh& deforming : level.deforming_meshes) {
        host::joint_matrices(deforming, pose, joints);
        host::deform(deforming, joints, pose.weights(deforming.node), shape);
        add(deforming.mesh.indices, shape.positions, list);
    }
    return std::move(list.triangles);
}

} // namespace peregrine::bench
