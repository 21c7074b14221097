#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::truth {

using Vec3 = std::array<float, 3>;

// What our engine and another renderer are both told. One kind of surface each.
struct Material {
    enum class Kind { matt, glowing, mirror, glass, pane };
    std::string name;
    Kind kind = Kind::matt;
    Vec3 color{0.8f, 0.8f, 0.8f}; // of matt: reflectance; of glowing: radiance
    float index = 1.5f;           // of glass
    Vec3 attenuation{1, 1, 1};    // of glass: what is left after a metre
};

struct Mesh {
    std::string material;
    std::vector<Vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

struct Lamp {
    Vec3 position;
    float candela;
    float source_radius; // 0: a point
};

struct Scene {
    std::string name;
    std::string what; // one line
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Lamp> lamps;
    Vec3 eye{0, 0, 0}, target{0, 0, -1};
    float vertical_fov = 0.8f;
    uint32_t max_depth = 16; // bounces
    float ambient = 0;       // white light from everywhere, which surfaces keep from each other
};

std::vector<Scene> scenes();

} // namespace peregrine::truth
