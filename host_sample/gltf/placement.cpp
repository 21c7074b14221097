#include "placement.h"

#include <cmath>

#include "../error.h"

namespace host::gltf {

namespace {

// Normals go by the inverse transpose. The cofactor matrix is that, times the determinant, and
// exists for flattening transforms too.
struct Transform {
    glm::dmat4 point;
    glm::dmat3 normal;
    bool mirrors;

    explicit Transform(const glm::dmat4& matrix) : point(matrix) {
        const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
        mirrors = glm::dot(glm::cross(x, y), z) < 0.0;
        normal = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
        if (mirrors) normal = -normal;
    }
};

glm::vec3 to_unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    // Zero stands for "unusable"; the importer replaces such normals by the face's.
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

void place_vertex(Primitive& primitive, size_t i, const Transform& transform) {
    primitive.positions[i] =
        glm::vec3(transform.point * glm::dvec4(glm::dvec3(primitive.positions[i]), 1.0));
    if (!primitive.normals.empty())
        primitive.normals[i] = to_unit(transform.normal * glm::dvec3(primitive.normals[i]));
    if (primitive.tangents.empty()) return;
    const glm::vec4 tangent = primitive.tangents[i];
    const glm::vec3 direction =
        to_unit(glm::dmat3(transform.point) * glm::dvec3(glm::vec3(tangent)));
    const bool left_handed = (tangent.w < 0.0f) != transform.mirrors;
    primitive.tangents[i] = glm::vec4(direction, left_handed ? -1.0f : 1.0f);
}

void turn_round(std::vector<uint32_t>& indices) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

struct Influences {
    std::vector<const Accessor*> joints, weights;
};

Influences find_influences(Accessors& accessors, const tinygltf::Primitive& source) {
    Influences influences;
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
        influences.joints.push_back(joints);
        influences.weights.push_back(weights);
    }
    return influences;
}

glm::dmat4 blend(const Influences& influences, const std::vector<glm::dmat4>& joints,
                 uint32_t vertex) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (size_t set = 0; set < influences.joints.size(); ++set) {
        for (int c = 0; c < 4; ++c) {
            const double weight = static_cast<double>(influences.weights[set]->read(vertex, c));
            if (!(weight > 0.0) || !std::isfinite(weight)) continue;
            const auto joint = static_cast<size_t>(influences.joints[set]->read(vertex, c));
            if (joint >= joints.size())
                throw InputError(influences.joints[set]->name() + " names joint "
                                 + std::to_string(joint) + ", but the skin has "
                                 + std::to_string(joints.size()));
            sum += weight * joints[joint];
            total += weight;
        }
    }
    return total > 0.0 ? sum / total : glm::dmat4(1.0);
}

} // namespace

void place_rigid(Primitive& primitive, const glm::dmat4& world) {
    const Transform transform(world);
    for (size_t i = 0; i < primitive.positions.size(); ++i) place_vertex(primitive, i, transform);
    if (transform.mirrors) turn_round(primitive.indices);
}

std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, Accessors& accessors,
                                       const NodeTree& tree, int skin) {
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
    std::vector<glm::dmat4> matrices;
    matrices.reserve(source.joints.size());
    for (const int joint : source.joints) {
        if (joint < 0 || static_cast<size_t>(joint) >= tree.world.size())
            throw InputError("skin " + std::to_string(skin) + " names node " + std::to_string(joint)
                             + ", which does not exist");
        const glm::dmat4 bind =
            inverse_bind ? glm::dmat4(inverse_bind->read_mat4(matrices.size())) : glm::dmat4(1.0);
        matrices.push_back(tree.world[static_cast<size_t>(joint)] * bind);
    }
    return matrices;
}

bool place_skinned(Primitive& primitive, Accessors& accessors, const tinygltf::Primitive& source,
                   const std::vector<glm::dmat4>& joints) {
    const Influences influences = find_influences(accessors, source);
    if (influences.joints.empty()) return false;
    size_t mirrored = 0;
    for (size_t i = 0; i < primitive.positions.size(); ++i) {
        const Transform transform(blend(influences, joints, primitive.vertices[i]));
        place_vertex(primitive, i, transform);
        mirrored += transform.mirrors ? 1 : 0;
    }
    if (2 * mirrored > primitive.positions.size()) turn_round(primitive.indices);
    return true;
}

} // namespace host::gltf
