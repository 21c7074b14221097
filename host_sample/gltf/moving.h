#pragma once

#include <array>
#include <map>

#include <tiny_gltf.h>

#include "../level.h"
#include "accessor.h"
#include "budget.h"
#include "mesh_parts.h"
#include "notes.h"
#include "rig.h"
#include "skin.h"

namespace host::gltf {

// Imports the meshes of nodes that move or are instanced: as rigid meshes, one for all nodes that
// show the same, or as deforming ones.
class MovingMeshes {
public:
    MovingMeshes(const tinygltf::Model& model, Accessors& accessors, RigBuilder& rig,
                 Budget& budget, Level& level, Notes& notes)
        : model_(model), accessors_(accessors), rig_(rig), budget_(budget), level_(level),
          notes_(notes) {}

    // True if the node's mesh is of these and was imported. Throws InputError.
    bool import_node(uint32_t node);

private:
    const std::vector<size_t>& open_rigid(uint32_t node);
    void add_rigid(uint32_t node);
    void add_instances(uint32_t node, const std::vector<glm::dmat4>& places);
    std::vector<size_t> read_rigid(const tinygltf::Node& node);
    void add_deforming(uint32_t node, const Skin& skin);
    void add_primitive(const tinygltf::Primitive& source, size_t joint_count,
                       std::array<DeformingMesh, mesh_groups>& groups);
    void add_targets(const tinygltf::Primitive& source, const Primitive& primitive,
                     DeformingMesh& group);
    void settle(DeformingMesh& mesh, const std::vector<glm::dmat4>& rest);

    const tinygltf::Model& model_;
    Accessors& accessors_;
    RigBuilder& rig_;
    Budget& budget_;
    Level& level_;
    Notes& notes_;
    std::map<std::pair<int, std::vector<double>>, std::vector<size_t>> rigid_;
};

} // namespace host::gltf
