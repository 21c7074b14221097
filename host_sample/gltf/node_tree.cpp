#include "node_tree.h"

#include <cstdint>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "../error.h"

namespace host::gltf {

namespace {

uint32_t checked_node(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<size_t>(index) >= model.nodes.size())
        throw InputError("node " + std::to_string(index) + " is named but does not exist");
    return static_cast<uint32_t>(index);
}

std::vector<bool> find_children(const tinygltf::Model& model) {
    std::vector<bool> has_parent(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            const uint32_t index = checked_node(model, child);
            if (has_parent[index])
                throw InputError("node " + std::to_string(index) + " has two parents");
            has_parent[index] = true;
        }
    }
    return has_parent;
}

void compute_world(const tinygltf::Model& model, const std::vector<bool>& has_parent,
                   NodeTree& tree) {
    tree.world.assign(model.nodes.size(), glm::dmat4(1.0));
    tree.parent.assign(model.nodes.size(), no_index);
    std::vector<uint32_t> open;
    for (uint32_t i = 0; i < model.nodes.size(); ++i) {
        if (has_parent[i]) continue;
        tree.world[i] = local_matrix(model.nodes[i]);
        open.push_back(i);
    }
    while (!open.empty()) {
        const uint32_t index = open.back();
        open.pop_back();
        tree.order.push_back(index);
        for (const int child : model.nodes[index].children) {
            const auto c = static_cast<uint32_t>(child);
            tree.parent[c] = index;
            tree.world[c] = tree.world[index] * local_matrix(model.nodes[c]);
            open.push_back(c);
        }
    }
    // With one parent each at most, what no root reaches lies on or behind a cycle.
    if (tree.order.size() != model.nodes.size()) throw InputError("its nodes form a cycle");
}

std::vector<int> choose_roots(const tinygltf::Model& model, const std::vector<bool>& has_parent) {
    if (model.scenes.empty()) {
        std::vector<int> roots;
        for (size_t i = 0; i < has_parent.size(); ++i)
            if (!has_parent[i]) roots.push_back(static_cast<int>(i));
        return roots;
    }
    if (model.defaultScene < 0) return model.scenes.front().nodes;
    if (static_cast<size_t>(model.defaultScene) >= model.scenes.size())
        throw InputError("its default scene does not exist");
    return model.scenes[static_cast<size_t>(model.defaultScene)].nodes;
}

} // namespace

Local local_of(const tinygltf::Node& node) {
    Local local;
    if (node.translation.size() == 3)
        local.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1],
                                  node.rotation[2]);
        if (glm::dot(rotation, rotation) > 0.0) local.rotation = glm::normalize(rotation);
    }
    if (node.scale.size() == 3) local.scale = {node.scale[0], node.scale[1], node.scale[2]};
    return local;
}

glm::dmat4 local_matrix(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        return matrix;
    }
    const Local local = local_of(node);
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), local.translation);
    return glm::scale(moved * glm::mat4_cast(local.rotation), local.scale);
}

NodeTree build_node_tree(const tinygltf::Model& model) {
    NodeTree tree;
    const std::vector<bool> has_parent = find_children(model);
    compute_world(model, has_parent, tree);

    std::vector<bool> visited(model.nodes.size(), false);
    std::vector<uint32_t> open;
    const std::vector<int> roots = choose_roots(model, has_parent);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        open.push_back(checked_node(model, *root));
    while (!open.empty()) {
        const uint32_t index = open.back();
        open.pop_back();
        if (visited[index])
            throw InputError("node " + std::to_string(index) + " is in the scene twice");
        visited[index] = true;
        tree.scene_nodes.push_back(index);
        const std::vector<int>& children = model.nodes[index].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            open.push_back(static_cast<uint32_t>(*child));
    }
    return tree;
}

} // namespace host::gltf
