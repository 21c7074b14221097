#include "mesh_parts.h"

#include <cmath>

#include "../error.h"

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

} // namespace

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

void grow(Bounds& bounds, const glm::dvec3& position) {
    if (!std::isfinite(position.x + position.y + position.z)) return;
    bounds.lower = glm::min(bounds.lower, position);
    bounds.upper = glm::max(bounds.upper, position);
}

void grow(Bounds& bounds, const Bounds& box, const glm::dmat4& place) {
    if (box.empty()) return;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = (corner >> axis & 1 ? box.upper : box.lower)[axis];
        grow(bounds, glm::dvec3(place * glm::dvec4(position, 1.0)));
    }
}

size_t group_of(const Primitive& primitive) {
    if (primitive.normals.empty()) return 0;
    return primitive.tangents.empty() ? 1 : 2;
}

const tinygltf::Mesh& checked_mesh(const tinygltf::Model& model, int mesh) {
    if (mesh < 0 || static_cast<size_t>(mesh) >= model.meshes.size())
        throw InputError("mesh " + std::to_string(mesh) + " is named but does not exist");
    return model.meshes[static_cast<size_t>(mesh)];
}

uint32_t checked_material(const tinygltf::Model& model, int material) {
    if (material < 0) return no_index;
    if (static_cast<size_t>(material) >= model.materials.size())
        throw InputError("material " + std::to_string(material) + " is named but does not exist");
    return static_cast<uint32_t>(material);
}

} // namespace host::gltf
