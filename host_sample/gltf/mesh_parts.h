#pragma once

#include <tiny_gltf.h>

#include "../level.h"
#include "primitive.h"

// How primitives become meshes.
namespace host::gltf {

// Absent normals mean flat shading, absent tangents derived ones: neither can be padded, so a
// file's mesh becomes up to this many.
inline constexpr size_t mesh_groups = 3;
size_t group_of(const Primitive& primitive);

// The engine takes normals and texcoords as they are; a NaN must not reach a pixel.
void repair_attributes(Primitive& primitive);

// Appends `added` elements after the first `before`, zeros where either side has none at all.
template <class T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t before, size_t added) {
    if (from.empty() && to.empty()) return;
    to.resize(before);
    to.insert(to.end(), from.begin(), from.end());
    to.resize(before + added);
}

void append_primitive(Mesh& mesh, const Primitive& primitive, uint32_t material);

// Throws InputError.
const tinygltf::Mesh& checked_mesh(const tinygltf::Model& model, int mesh);
uint32_t checked_material(const tinygltf::Model& model, int material); // no_index: the default

void grow(Bounds& bounds, const glm::dvec3& position); // not by one that is not finite
void grow(Bounds& bounds, const Bounds& box, const glm::dmat4& place);

} // namespace host::gltf
