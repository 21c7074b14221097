#include "rig.h"

namespace host::gltf {

namespace {

const std::vector<double>& rest_weights(const tinygltf::Model& model, const tinygltf::Node& node) {
    const bool of_mesh = node.weights.empty() && node.mesh >= 0
                         && static_cast<size_t>(node.mesh) < model.meshes.size();
    return of_mesh ? model.meshes[static_cast<size_t>(node.mesh)].weights : node.weights;
}

} // namespace

RigBuilder::RigBuilder(const tinygltf::Model& model, const NodeTree& tree, std::vector<Clip> clips,
                       const NodeFilter& moved, Rig& rig)
    : model_(model), tree_(tree), rig_(rig), moves_(model.nodes.size(), false),
      morphs_(model.nodes.size(), false), numbers_(model.nodes.size(), no_index) {
    std::vector<bool> driven(model.nodes.size(), false);
    for (const Clip& clip : clips)
        for (const Track& track : clip.tracks)
            (track.property == Property::weights ? morphs_ : driven)[track.node] = true;
    add_moving(driven, moved);
    for (Clip& clip : clips)
        for (Track& track : clip.tracks) track.node = find_or_add(track.node);
    rig_.clips = std::move(clips);
}

void RigBuilder::add_moving(const std::vector<bool>& driven, const NodeFilter& moved) {
    for (const uint32_t node : tree_.order) {
        const uint32_t parent = tree_.parent[node];
        const bool follows = parent != no_index && moves_[parent];
        const tinygltf::Node& source = model_.nodes[node];
        if (!driven[node] && !follows && !(moved && moved(source.name))) continue;
        RigNode added;
        added.name = source.name;
        added.driven = driven[node];
        added.weights = rest_weights(model_, source);
        if (follows)
            added.parent = numbers_[parent];
        else if (parent != no_index)
            added.before = tree_.world[parent];
        if (driven[node])
            added.rest = local_of(source);
        else
            added.before = added.before * local_matrix(source);
        moves_[node] = true;
        numbers_[node] = static_cast<uint32_t>(rig_.nodes.size());
        rig_.nodes.push_back(std::move(added));
    }
}

uint32_t RigBuilder::find_or_add(uint32_t node) {
    if (numbers_[node] == no_index) {
        numbers_[node] = static_cast<uint32_t>(rig_.nodes.size());
        RigNode& added = rig_.nodes.emplace_back();
        added.name = model_.nodes[node].name;
        added.before = tree_.world[node];
        added.weights = rest_weights(model_, model_.nodes[node]);
    }
    return numbers_[node];
}

uint32_t RigBuilder::add_below(uint32_t node, const glm::dmat4& place) {
    RigNode added;
    added.name = model_.nodes[node].name;
    added.parent = find_or_add(node);
    added.before = place;
    rig_.nodes.push_back(std::move(added));
    return static_cast<uint32_t>(rig_.nodes.size() - 1);
}

} // namespace host::gltf
