#include "shapes.h"

namespace peregrine::test {
namespace {

using glm::vec2;
using glm::vec3;

template <class T>
rt_array array_of(const std::vector<T>& values) {
    return {values.empty() ? nullptr : values.data(), values.size(), 0, 0};
}

void append(Shape& shape, const Shape& other) {
    const auto first = uint32_t(shape.positions.size());
    const auto add = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    add(shape.positions, other.positions);
    add(shape.texcoords, other.texcoords);
    for (const uint32_t index : other.indices) shape.indices.push_back(first + index);
}

// The sides of the cube from -1 to 1, seen from outside.
Shape make_cube(uint32_t cells) {
    Shape cube;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            vec3 corner(-1), u(0), v(0);
            corner[axis] = side;
            u[(axis + 1) % 3] = 2;
            v[(axis + 2) % 3] = 2;
            append(cube,
                   side > 0 ? make_grid(corner, u, v, cells) : make_grid(corner, v, u, cells));
        }
    return cube;
}

} // namespace

rt_mesh_desc Shape::desc() const {
    rt_mesh_desc desc = rt_default_mesh_desc();
    desc.positions = array_of(positions);
    desc.normals = array_of(normals);
    desc.tangents = array_of(tangents);
    desc.texcoords = array_of(texcoords);
    desc.texcoords1 = array_of(texcoords1);
    desc.indices = array_of(indices);
    return desc;
}

Shape make_grid(const vec3& corner, const vec3& u, const vec3& v, uint32_t cells) {
    Shape grid;
    for (uint32_t j = 0; j <= cells; ++j)
        for (uint32_t i = 0; i <= cells; ++i) {
            const vec2 place = vec2(float(i), float(j)) / float(cells);
            grid.positions.push_back(corner + place.x * u + place.y * v);
            grid.texcoords.push_back(place);
        }
    for (uint32_t j = 0; j < cells; ++j)
        for (uint32_t i = 0; i < cells; ++i) {
            const uint32_t a = j * (cells + 1) + i, b = a + cells + 1;
            grid.indices.insert(grid.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    return grid;
}

Shape make_ball(const vec3& center, float radius, uint32_t cells) {
    Shape ball = make_cube(cells);
    for (vec3& position : ball.positions) {
        const vec3 normal = position / std::sqrt(glm::dot(position, position));
        ball.normals.push_back(normal);
        position = center + radius * normal;
    }
    return ball;
}

Shape make_box() {
    return make_cube(1);
}

Shape make_flag(const vec3& corner, float phase) {
    Shape flag = make_grid(corner, {2, 0, 0}, {0, -1.2f, 0}, 8);
    for (size_t i = 0; i < flag.positions.size(); ++i) {
        const float x = flag.texcoords[i].x, wave = x + phase;
        flag.positions[i].z += 0.8f * x * (wave - 0.5f) * (1.5f - wave);
        flag.positions[i].y -= 0.3f * x * x * phase;
    }
    return flag;
}

} // namespace peregrine::test
