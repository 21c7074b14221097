#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

namespace host::gltf {

struct NodeTree {
    std::vector<glm::dmat4> world;     // of every node, whether in the scene or not
    std::vector<uint32_t> scene_nodes; // those of the chosen scene, parents first
};

// Throws InputError if a node is its own ancestor, has two parents or does not exist.
NodeTree build_node_tree(const tinygltf::Model& model);

} // namespace host::gltf
