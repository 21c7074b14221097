#pragma once

#include <vector>

#include <tiny_gltf.h>

#include "../animation/rig.h"
#include "import.h"
#include "node_tree.h"

namespace host::gltf {

// Gathers the nodes that move, and those that moving meshes refer to, into a rig.
class RigBuilder {
public:
    // The clips' tracks name nodes by the file's numbers, the rig's by its own.
    RigBuilder(const tinygltf::Model& model, const NodeTree& tree, std::vector<Clip> clips,
               const NodeFilter& moved, Rig& rig);

    // Whether the node or one above it is driven by a clip or moved by the host.
    bool moves(uint32_t node) const { return moves_[node]; }
    bool morphs(uint32_t node) const { return morphs_[node]; }

    const glm::dmat4& world(uint32_t node) const { return tree_.world[node]; } // at rest

    // Its number in the rig; no_index if it does not move.
    uint32_t find(uint32_t node) const { return moves_[node] ? numbers_[node] : no_index; }

    // The same for any node: one that does not move becomes a node of the rig that stands still.
    uint32_t find_or_add(uint32_t node);

    // A node of the rig's own, at a place relative to a node of the file.
    uint32_t add_below(uint32_t node, const glm::dmat4& place);

private:
    void add_moving(const std::vector<bool>& driven, const NodeFilter& moved);

    const tinygltf::Model& model_;
    const NodeTree& tree_;
    Rig& rig_;
    std::vector<bool> moves_, morphs_;
    std::vector<uint32_t> numbers_;
};

} // namespace host::gltf
