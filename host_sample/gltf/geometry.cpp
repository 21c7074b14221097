#include "geometry.h"

#include <array>
#include <cmath>
#include <span>

#include "../error.h"
#include "placement.h"
#include "primitive.h"

namespace host::gltf {

namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_usable(const glm::vec3& v) {
    return is_finite(v) && glm::dot(v, v) > 0.0f;
}

glm::vec3 face_normal(const Primitive& primitive, size_t corner) {
    const auto at = [&](size_t i) {
        return glm::dvec3(primitive.positions[primitive.indices[corner + i]]);
    };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    const double length = glm::length(normal);
    const bool usable = length > 0.0 && std::isfinite(length);
    return usable ? glm::vec3(normal / length) : glm::vec3(0.0f, 1.0f, 0.0f);
}

// The engine takes normals and texcoords as they are; a NaN must not reach a pixel.
void repair_attributes(Primitive& primitive) {
    if (!primitive.normals.empty())
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
            for (size_t c = 0; c < 3; ++c) {
                glm::vec3& normal = primitive.normals[primitive.indices[i + c]];
                if (!is_usable(normal)) normal = face_normal(primitive, i);
            }
    for (glm::vec4& tangent : primitive.tangents)
        if (!is_usable(glm::vec3(tangent))) tangent = {1.0f, 0.0f, 0.0f, 1.0f};
    for (auto* set : {&primitive.texcoords, &primitive.texcoords1})
        for (glm::vec2& texcoord : *set)
            if (!std::isfinite(texcoord.x) || !std::isfinite(texcoord.y)) texcoord = glm::vec2(0);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t before, size_t added) {
    if (from.empty() && to.empty()) return;
    to.resize(before); // pads with zeros what earlier primitives lacked
    to.insert(to.end(), from.begin(), from.end());
    to.resize(before + added);
}

void append_primitive(Mesh& mesh, const Primitive& primitive, uint32_t material) {
    const size_t before = mesh.positions.size(), added = primitive.positions.size();
    if (before + added > no_index) throw InputError("a mesh has more than 2^32 vertices");
    append(mesh.positions, primitive.positions, before, added);
    append(mesh.normals, primitive.normals, before, added);
    append(mesh.tangents, primitive.tangents, before, added);
    append(mesh.texcoords, primitive.texcoords, before, added);
    append(mesh.texcoords1, primitive.texcoords1, before, added);
    for (const uint32_t index : primitive.indices)
        mesh.indices.push_back(index + static_cast<uint32_t>(before));
    mesh.materials.resize(mesh.materials.size() + primitive.indices.size() / 3, material);
}

void grow(Bounds& bounds, const std::vector<glm::vec3>& positions) {
    for (const glm::vec3& position : positions) {
        if (!is_finite(position)) continue;
        bounds.lower = glm::min(bounds.lower, glm::dvec3(position));
        bounds.upper = glm::max(bounds.upper, glm::dvec3(position));
    }
}

uint32_t checked_material(const tinygltf::Model& model, int material) {
    if (material < 0) return no_index;
    if (static_cast<size_t>(material) >= model.materials.size())
        throw InputError("material " + std::to_string(material) + " is named but does not exist");
    return static_cast<uint32_t>(material);
}

class NodeBaker {
public:
    NodeBaker(const tinygltf::Model& model, const NodeTree& tree, Accessors& accessors,
              Budget& budget, Level& level, Notes& notes)
        : model_(model), tree_(tree), accessors_(accessors), budget_(budget), level_(level),
          notes_(notes) {}

    void bake(uint32_t node_index) {
        const tinygltf::Node& node = model_.nodes[node_index];
        if (node.mesh < 0) return;
        if (static_cast<size_t>(node.mesh) >= model_.meshes.size())
            throw InputError("mesh " + std::to_string(node.mesh) + " is named but does not exist");
        const tinygltf::Mesh& source = model_.meshes[static_cast<size_t>(node.mesh)];
        const std::span<const double> weights =
            node.weights.empty() ? source.weights : node.weights;
        std::vector<glm::dmat4> joints;
        if (node.skin >= 0) {
            joints = joint_matrices(model_, accessors_, tree_, node.skin);
            budget_.spend(joints.size());
        }

        // Absent normals mean flat shading, absent tangents derived ones: neither can be padded.
        std::array<Mesh, 3> groups;
        for (const tinygltf::Primitive& primitive : source.primitives)
            add(primitive, weights, joints, tree_.world[node_index], groups);
        for (Mesh& group : groups) {
            if (group.indices.empty()) continue;
            group.name = node.name.empty() ? source.name : node.name;
            grow(level_.bounds, group.positions);
            level_.meshes.push_back(std::move(group));
        }
    }

private:
    void add(const tinygltf::Primitive& source, std::span<const double> weights,
             const std::vector<glm::dmat4>& joints, const glm::dmat4& world,
             std::array<Mesh, 3>& groups) {
        auto primitive = read_primitive(accessors_, source, weights, budget_, notes_);
        if (!primitive) return;
        if (joints.empty() || !place_skinned(*primitive, accessors_, source, joints))
            place_rigid(*primitive, world);
        repair_attributes(*primitive);
        const size_t group = primitive->normals.empty() ? 0 : primitive->tangents.empty() ? 1 : 2;
        append_primitive(groups[group], *primitive, checked_material(model_, source.material));
    }

    const tinygltf::Model& model_;
    const NodeTree& tree_;
    Accessors& accessors_;
    Budget& budget_;
    Level& level_;
    Notes& notes_;
};

} // namespace

void import_geometry(const tinygltf::Model& model, const NodeTree& tree, Accessors& accessors,
                     Budget& budget, Level& level, Notes& notes) {
    NodeBaker baker(model, tree, accessors, budget, level, notes);
    for (const uint32_t node : tree.scene_nodes) baker.bake(node);
}

} // namespace host::gltf
