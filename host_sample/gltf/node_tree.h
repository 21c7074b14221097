#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "../animation/rig.h"

namespace host::gltf {

struct NodeTree {
    std::vector<glm::dmat4> world;     // of every node, whether in the scene or not
    std::vector<uint32_t> parent;      // of every node; no_index: none
    std::vector<uint32_t> order;       // every node, parents first
    std::vector<uint32_t> scene_nodes; // those of the chosen scene, parents first
};

// The transform of a node that has no matrix.
Local local_of(const tinygltf::Node& node);
glm::dmat4 local_matrix(const tinygltf::Node& node);

// Throws InputError if a node is its own ancestor, has two parents or does not exist.
NodeTree build_node_tree(const tinygltf::Model& model);

} // namespace host::gltf
