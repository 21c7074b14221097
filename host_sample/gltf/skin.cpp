#include "skin.h"

#include <cmath>

#include "../error.h"
#include "primitive.h"

namespace host::gltf {

namespace {

struct Set {
    const Accessor *joints, *weights;
};

std::vector<Set> find_sets(Accessors& accessors, const tinygltf::Primitive& source) {
    std::vector<Set> sets;
    const Accessor* positions = find_attribute(accessors, source.attributes, "POSITION", 0);
    for (int set = 0; positions && set < 4; ++set) {
        const std::string suffix = std::to_string(set);
        const auto find = [&](const std::string& name) {
            return find_attribute(accessors, source.attributes, name.c_str(), positions->count());
        };
        const Accessor* joints = find("JOINTS_" + suffix);
        const Accessor* weights = find("WEIGHTS_" + suffix);
        if (!joints || !weights) break;
        if (!joints->is_unsigned_integer())
            throw InputError(joints->name() + " holds joints but is not of an unsigned type");
        sets.push_back({joints, weights});
    }
    return sets;
}

void add_influences(const Set& set, uint32_t vertex, size_t joint_count, Influences& influences) {
    for (int c = 0; c < 4; ++c) {
        const float weight = set.weights->read(vertex, c);
        if (!(weight > 0.0f) || !std::isfinite(weight)) continue;
        const auto joint = static_cast<size_t>(set.joints->read(vertex, c));
        if (joint >= joint_count)
            throw InputError(set.joints->name() + " names joint " + std::to_string(joint)
                             + ", but the skin has " + std::to_string(joint_count));
        influences.list.push_back({static_cast<uint32_t>(joint), weight});
    }
}

} // namespace

Skin read_skin(const tinygltf::Model& model, Accessors& accessors, int skin) {
    if (skin < 0 || static_cast<size_t>(skin) >= model.skins.size())
        throw InputError("skin " + std::to_string(skin) + " is named but does not exist");
    const tinygltf::Skin& source = model.skins[static_cast<size_t>(skin)];
    const Accessor* inverse_bind = nullptr;
    if (source.inverseBindMatrices >= 0) {
        inverse_bind = &accessors.open(source.inverseBindMatrices);
        if (inverse_bind->count() < source.joints.size() || inverse_bind->components() != 16)
            throw InputError(inverse_bind->name() + " is no matrix for every joint of skin "
                             + std::to_string(skin));
    }
    Skin result;
    for (const int joint : source.joints) {
        if (joint < 0 || static_cast<size_t>(joint) >= model.nodes.size())
            throw InputError("skin " + std::to_string(skin) + " names node " + std::to_string(joint)
                             + ", which does not exist");
        result.inverse_bind.push_back(inverse_bind
                                          ? glm::dmat4(inverse_bind->read_mat4(result.nodes.size()))
                                          : glm::dmat4(1.0));
        result.nodes.push_back(static_cast<uint32_t>(joint));
    }
    return result;
}

std::optional<Influences> read_influences(Accessors& accessors, const tinygltf::Primitive& source,
                                          std::span<const uint32_t> vertices, size_t joint_count) {
    const std::vector<Set> sets = find_sets(accessors, source);
    if (sets.empty()) return std::nullopt;
    Influences influences;
    influences.first.reserve(vertices.size() + 1);
    influences.first.push_back(0);
    for (const uint32_t vertex : vertices) {
        for (const Set& set : sets) add_influences(set, vertex, joint_count, influences);
        influences.first.push_back(static_cast<uint32_t>(influences.list.size()));
    }
    return influences;
}

} // namespace host::gltf
