#include "moving.h"

#include <algorithm>

#include "../animation/pose.h"
#include "../animation/skinning.h"
#include "instancing.h"
#include "placement.h"

namespace host::gltf {

namespace {

std::string name_of(const tinygltf::Node& node, const tinygltf::Mesh& mesh) {
    return node.name.empty() ? mesh.name : node.name;
}

std::vector<glm::vec3> gather(const std::vector<uint32_t>& vertices, const Accessor* accessor) {
    std::vector<glm::vec3> values;
    if (!accessor) return values;
    values.reserve(vertices.size());
    for (const uint32_t vertex : vertices) values.push_back(accessor->read_vec3(vertex));
    return values;
}

// The weights of each vertex are made to sum to 1.
void append_influences(DeformingMesh& mesh, const Influences& influences) {
    if (mesh.first_influence.empty()) mesh.first_influence.push_back(0);
    for (size_t vertex = 0; vertex + 1 < influences.first.size(); ++vertex) {
        const uint32_t first = influences.first[vertex], end = influences.first[vertex + 1];
        double total = 0.0;
        for (uint32_t i = first; i < end; ++i)
            total += static_cast<double>(influences.list[i].weight);
        for (uint32_t i = first; i < end; ++i) {
            const double weight = static_cast<double>(influences.list[i].weight) / total;
            mesh.influences.push_back({influences.list[i].joint, static_cast<float>(weight)});
        }
        mesh.first_influence.push_back(static_cast<uint32_t>(mesh.influences.size()));
    }
}

// Every vertex follows one joint.
Influences follow_one(size_t vertex_count, uint32_t joint) {
    Influences influences;
    influences.list.assign(vertex_count, {joint, 1.0f});
    for (uint32_t i = 0; i <= vertex_count; ++i) influences.first.push_back(i);
    return influences;
}

bool mirrors(const glm::mat4x3& matrix) {
    return glm::dot(glm::cross(matrix[0], matrix[1]), matrix[2]) < 0.0f;
}

} // namespace

bool MovingMeshes::import_node(uint32_t node) {
    const tinygltf::Node& source = model_.nodes[node];
    Skin skin;
    if (source.skin >= 0) {
        skin = read_skin(model_, accessors_, source.skin);
        budget_.spend(skin.nodes.size());
    }
    const bool skinned = std::any_of(skin.nodes.begin(), skin.nodes.end(),
                                     [&](uint32_t joint) { return rig_.moves(joint); });
    const bool deforms = skinned || rig_.morphs(node);
    const bool whole = rig_.moves(node) && skin.nodes.empty();
    const auto instances = read_instances(source, accessors_, budget_, notes_);
    const bool instanced = instances && skin.nodes.empty() && !deforms;
    if (instances && !instanced) notes_.add("instances of meshes that deform are drawn once");
    if (deforms)
        add_deforming(node, skin);
    else if (instanced)
        add_instances(node, *instances);
    else if (whole)
        add_rigid(node);
    return deforms || instanced || whole;
}

const std::vector<size_t>& MovingMeshes::open_rigid(uint32_t node) {
    const tinygltf::Node& source = model_.nodes[node];
    const auto [entry, added] = rigid_.try_emplace({source.mesh, source.weights});
    if (added) entry->second = read_rigid(source);
    return entry->second;
}

// Their bounds are those of the mesh's box: there may be many more of them than vertices.
void MovingMeshes::add_instances(uint32_t node, const std::vector<glm::dmat4>& places) {
    if (places.empty()) return;
    std::vector<uint32_t> numbers;
    if (rig_.moves(node))
        for (const glm::dmat4& place : places) numbers.push_back(rig_.add_below(node, place));
    for (const size_t index : open_rigid(node)) {
        RigidMesh& rigid = level_.rigid_meshes[index];
        budget_.spend(rigid.mesh.positions.size());
        Bounds box;
        for (const glm::vec3& position : rigid.mesh.positions) grow(box, glm::dvec3(position));
        rigid.nodes.insert(rigid.nodes.end(), numbers.begin(), numbers.end());
        for (const glm::dmat4& place : places) {
            budget_.spend(1);
            const glm::dmat4 world = rig_.world(node) * place;
            grow(level_.bounds, box, world);
            if (numbers.empty()) rigid.places.push_back(world);
        }
    }
}

void MovingMeshes::add_rigid(uint32_t node) {
    const uint32_t number = rig_.find_or_add(node);
    for (const size_t index : open_rigid(node)) {
        RigidMesh& rigid = level_.rigid_meshes[index];
        budget_.spend(rigid.mesh.positions.size());
        rigid.nodes.push_back(number);
        for (const glm::vec3& position : rigid.mesh.positions)
            grow(level_.bounds,
                 glm::dvec3(rig_.world(node) * glm::dvec4(glm::dvec3(position), 1.0)));
    }
}

std::vector<size_t> MovingMeshes::read_rigid(const tinygltf::Node& node) {
    const tinygltf::Mesh& source = checked_mesh(model_, node.mesh);
    std::array<Mesh, mesh_groups> groups;
    for (const tinygltf::Primitive& part : source.primitives) {
        auto primitive =
            read_primitive(accessors_, part, node.weights.empty() ? source.weights : node.weights,
                           budget_, notes_);
        if (!primitive) continue;
        place_rigid(*primitive, glm::dmat4(1.0)); // normals and tangents become unit vectors
        repair_attributes(*primitive);
        append_primitive(groups[group_of(*primitive)], *primitive,
                         checked_material(model_, part.material));
    }
    std::vector<size_t> indices;
    for (Mesh& group : groups) {
        if (group.indices.empty()) continue;
        group.name = name_of(node, source);
        indices.push_back(level_.rigid_meshes.size());
        level_.rigid_meshes.push_back({std::move(group), {}, {}});
    }
    return indices;
}

void MovingMeshes::add_deforming(uint32_t node, const Skin& skin) {
    const tinygltf::Mesh& source = checked_mesh(model_, model_.nodes[node].mesh);
    std::array<DeformingMesh, mesh_groups> groups;
    for (const tinygltf::Primitive& part : source.primitives)
        add_primitive(part, skin.nodes.size(), groups);
    for (DeformingMesh& group : groups) {
        if (group.mesh.indices.empty()) continue;
        group.mesh.name = name_of(model_.nodes[node], source);
        group.node = rig_.find_or_add(node);
        std::vector<glm::dmat4> rest;
        for (size_t i = 0; i < skin.nodes.size(); ++i) {
            group.joints.push_back({rig_.find_or_add(skin.nodes[i]), skin.inverse_bind[i]});
            rest.push_back(rig_.world(skin.nodes[i]) * skin.inverse_bind[i]);
        }
        group.joints.push_back({group.node, glm::dmat4(1.0)}); // of what has no skin
        rest.push_back(rig_.world(node));
        settle(group, rest);
        level_.deforming_meshes.push_back(std::move(group));
    }
}

void MovingMeshes::add_primitive(const tinygltf::Primitive& source, size_t joint_count,
                                 std::array<DeformingMesh, mesh_groups>& groups) {
    auto primitive = read_primitive(accessors_, source, {}, budget_, notes_);
    if (!primitive) return;
    place_rigid(*primitive, glm::dmat4(1.0));
    repair_attributes(*primitive);
    DeformingMesh& group = groups[group_of(*primitive)];
    std::optional<Influences> influences;
    if (joint_count > 0)
        influences = read_influences(accessors_, source, primitive->vertices, joint_count);
    append_influences(group, influences ? *influences
                                        : follow_one(primitive->vertices.size(),
                                                     static_cast<uint32_t>(joint_count)));
    add_targets(source, *primitive, group);
    append_primitive(group.mesh, *primitive, checked_material(model_, source.material));
}

void MovingMeshes::add_targets(const tinygltf::Primitive& source, const Primitive& primitive,
                               DeformingMesh& group) {
    const size_t before = group.vertex_count(), added = primitive.positions.size();
    const uint64_t needed = added == 0 ? 0 : uint64_t{primitive.vertices.back()} + 1;
    if (group.targets.size() < source.targets.size()) group.targets.resize(source.targets.size());
    for (size_t i = 0; i < group.targets.size(); ++i) {
        budget_.spend(added);
        const auto read = [&](const char* name) {
            const bool has = i < source.targets.size();
            return gather(primitive.vertices,
                          has ? find_attribute(accessors_, source.targets[i], name, needed)
                              : nullptr);
        };
        MorphTarget& target = group.targets[i];
        append(target.positions, read("POSITION"), before, added);
        append(target.normals, read("NORMAL"), before, added);
        append(target.tangents, read("TANGENT"), before, added);
    }
}

// Bounds and winding are those of the rest pose.
void MovingMeshes::settle(DeformingMesh& mesh, const std::vector<glm::dmat4>& rest) {
    std::vector<glm::mat4x3> joints;
    for (const glm::dmat4& matrix : rest)
        joints.push_back(to_affine(relative_to(level_.origin, matrix)));
    Shape shape;
    deform(mesh, joints, level_.rig.nodes[mesh.node].weights, shape);
    size_t mirrored = 0;
    for (size_t i = 0; i < shape.positions.size(); ++i) {
        grow(level_.bounds, level_.origin + glm::dvec3(shape.positions[i]));
        mirrored += mirrors(blend_joints(mesh, joints, i)) ? 1 : 0;
    }
    if (2 * mirrored <= shape.positions.size()) return;
    turn_round(mesh.mesh.indices);
    for (glm::vec4& tangent : mesh.mesh.tangents) tangent.w = -tangent.w;
}

} // namespace host::gltf
