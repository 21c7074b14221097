#pragma once

#include <peregrine/rt.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace peregrine::test {

// A mesh that is still to be described.
struct Shape {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texcoords, texcoords1;
    std::vector<uint32_t> indices;

    // Its arrays are borrowed.
    rt_mesh_desc desc() const;
};

// A rectangle of cells x cells quads: corner, and the sides along u and v.
Shape make_grid(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, uint32_t cells);

// A ball from a cube, with the normals of a ball.
Shape make_ball(const glm::vec3& center, float radius, uint32_t cells);

// A cube about the origin, from -1 to 1, of faces of their own.
Shape make_box();

// A flag from `corner` along +x and down, waving as `phase` goes from 0 to 1.
Shape make_flag(const glm::vec3& corner, float phase);

} // namespace peregrine::test
