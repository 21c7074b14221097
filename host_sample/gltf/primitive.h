#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include "accessor.h"
#include "budget.h"
#include "notes.h"

namespace host::gltf {

// One primitive as a list of triangles over just the vertices that they use, in the space of its
// mesh. Attribute arrays are empty or as long as `positions`.
struct Primitive {
    std::vector<uint32_t> vertices; // of the file, for the attributes that skinning reads
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texcoords, texcoords1;
    std::vector<uint32_t> indices;
};

bool is_triangles(int mode);

// Nothing for points and lines. `weights` are those of the morph targets. Throws InputError.
std::optional<Primitive> read_primitive(Accessors& accessors, const tinygltf::Primitive& source,
                                        std::span<const double> weights, Budget& budget,
                                        Notes& notes);

// The accessor of an attribute; null if the primitive has none of that name or, for all but
// POSITION, its count differs from that of the positions. Throws InputError.
const Accessor* find_attribute(Accessors& accessors, const std::map<std::string, int>& attributes,
                               const char* name, uint64_t vertex_count);

} // namespace host::gltf
