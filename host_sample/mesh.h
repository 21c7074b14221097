#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace host {

inline constexpr uint32_t no_index = std::numeric_limits<uint32_t>::max();

// Attribute arrays are empty or as long as `positions`.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texcoords, texcoords1;
    std::vector<uint32_t> indices;   // three a triangle
    std::vector<uint32_t> materials; // one a triangle; no_index: the default material

    size_t triangle_count() const { return materials.size(); }
};

} // namespace host
