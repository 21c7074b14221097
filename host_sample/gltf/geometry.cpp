#include "geometry.h"

#include <array>
#include <span>

#include "../animation/pose.h"
#include "../error.h"
#include "extent.h"
#include "mesh_parts.h"
#include "moving.h"
#include "placement.h"

namespace host::gltf {

namespace {

// Meshes that stand still.
class NodeBaker {
public:
    NodeBaker(const tinygltf::Model& model, const NodeTree& tree, Accessors& accessors,
              Budget& budget, Level& level, Notes& notes)
        : model_(model), tree_(tree), accessors_(accessors), budget_(budget), level_(level),
          notes_(notes) {}

    void bake(uint32_t node_index) {
        const tinygltf::Node& node = model_.nodes[node_index];
        const tinygltf::Mesh& source = checked_mesh(model_, node.mesh);
        const std::span<const double> weights =
            node.weights.empty() ? source.weights : node.weights;
        std::vector<glm::dmat4> joints;
        if (node.skin >= 0) {
            joints = rest_joints(node.skin);
            budget_.spend(joints.size());
        }
        std::array<Mesh, mesh_groups> groups;
        for (const tinygltf::Primitive& primitive : source.primitives)
            add(primitive, weights, joints, relative_to(level_.origin, tree_.world[node_index]),
                groups);
        for (Mesh& group : groups) {
            if (group.indices.empty()) continue;
            group.name = node.name.empty() ? source.name : node.name;
            for (const glm::vec3& position : group.positions)
                grow(level_.bounds, level_.origin + glm::dvec3(position));
            level_.meshes.push_back(std::move(group));
        }
    }

private:
    std::vector<glm::dmat4> rest_joints(int index) {
        const Skin skin = read_skin(model_, accessors_, index);
        std::vector<glm::dmat4> matrices;
        for (size_t i = 0; i < skin.nodes.size(); ++i)
            matrices.push_back(
                relative_to(level_.origin, tree_.world[skin.nodes[i]] * skin.inverse_bind[i]));
        return matrices;
    }

    void add(const tinygltf::Primitive& source, std::span<const double> weights,
             const std::vector<glm::dmat4>& joints, const glm::dmat4& place,
             std::array<Mesh, mesh_groups>& groups) {
        auto primitive = read_primitive(accessors_, source, weights, budget_, notes_);
        if (!primitive) return;
        std::optional<Influences> influences;
        if (!joints.empty())
            influences = read_influences(accessors_, source, primitive->vertices, joints.size());
        if (influences)
            place_skinned(*primitive, *influences, joints,
                          relative_to(level_.origin, glm::dmat4(1.0)));
        else
            place_rigid(*primitive, place);
        repair_attributes(*primitive);
        append_primitive(groups[group_of(*primitive)], *primitive,
                         checked_material(model_, source.material));
    }

    const tinygltf::Model& model_;
    const NodeTree& tree_;
    Accessors& accessors_;
    Budget& budget_;
    Level& level_;
    Notes& notes_;
};

} // namespace

void import_geometry(const Document& document, const NodeTree& tree, Accessors& accessors,
                     RigBuilder& rig, Budget& budget, Level& level, Notes& notes) {
    const tinygltf::Model& model = document.model;
    level.origin = choose_origin(estimate_extent(document, tree, accessors));
    NodeBaker baker(model, tree, accessors, budget, level, notes);
    MovingMeshes moving(model, accessors, rig, budget, level, notes);
    for (const uint32_t node : tree.scene_nodes)
        if (model.nodes[node].mesh >= 0 && !moving.import_node(node)) baker.bake(node);
}

} // namespace host::gltf
