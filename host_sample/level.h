#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "animation/rig.h"
#include "mesh.h"

// What was read from a scene file: plain data that knows neither the file format nor the engine.
// All but what moves or stands in many places is baked to world space.
namespace host {

struct Image {
    std::string name;
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba; // top row first
};

enum class Wrap { repeat, mirror, clamp };

struct Texture {
    uint32_t image = no_index;
    bool srgb = true;
    bool nearest = false;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;

    friend auto operator<=>(const Texture&, const Texture&) = default;
};

struct TextureUse {
    uint32_t texture = no_index;
    float transform[6] = {1, 0, 0, 0, 1, 0}; // two rows of a 2x3 matrix
    uint32_t texcoord_set = 0;
};

struct Material {
    std::string name;
    glm::vec4 base_color{1.0f};
    glm::vec3 emissive{0.0f};
    glm::vec3 specular{0.0f};
    float shininess = 1.0f;
    float normal_scale = 1.0f;
    float alpha_cutoff = 0.5f;
    float reflectivity = 0.0f;
    glm::vec3 reflection_color{1.0f};
    float transmission = 0.0f;
    float index_of_refraction = 1.5f;
    glm::vec3 attenuation_color{1.0f};
    float attenuation_distance = 0.0f; // 0: nothing is lost
    bool thin = false;
    bool unlit = false; // KHR_materials_unlit: its `emissive` is no light
    bool masked = false;
    bool blended = false;
    bool double_sided = false;
    TextureUse base_color_texture, normal_texture, emissive_texture;
    TextureUse occlusion_texture, roughness_texture; // as of rt_material_desc
    float occlusion_strength = 1.0f, roughness = 1.0f, metalness = 1.0f;
};

enum class LightType { point, spot, directional };

struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::dvec3 position{0.0};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};
    glm::vec3 intensity{1.0f};
    float radius = 10.0f;       // infinite: no end
    float source_radius = 0.0f; // rt_light_desc::source_radius
    float fog_scatter = 0.0f;   // rt_light_desc::fog_scatter
    float cone_inner_cos = 1.0f, cone_outer_cos = 0.70710678f;
    uint32_t node = no_index; // of the rig: what it follows
};

struct Viewpoint {
    std::string name;
    glm::dvec3 position{0.0};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float vertical_fov = 1.0471976f;
    uint32_t node = no_index; // of the rig: what it follows
};

struct Bounds {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(lower.x <= upper.x); }
    double diagonal() const { return empty() ? 0.0 : glm::length(upper - lower); }
    glm::dvec3 center() const { return empty() ? glm::dvec3(0.0) : 0.5 * (lower + upper); }
};

struct Level {
    std::string name;
    // What the vertices of `meshes` and of deforming meshes in a pose are relative to: floats would
    // lose those of a level that lies far away. All else is relative to (0, 0, 0).
    glm::dvec3 origin{0.0};
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes; // that stand still
    std::vector<RigidMesh> rigid_meshes;
    std::vector<DeformingMesh> deforming_meshes;
    Rig rig;
    std::vector<Light> lights;
    std::vector<Viewpoint> cameras;
    std::vector<Viewpoint> spawns;
    std::vector<Viewpoint> places;  // the other nodes that have a name and nothing else
    Bounds bounds;                  // of the finite vertices, at rest
    std::vector<std::string> notes; // what was ignored or replaced, a sentence each

    size_t triangle_count() const {
        size_t count = 0;
        for (const Mesh& mesh : meshes) count += mesh.triangle_count();
        for (const RigidMesh& rigid : rigid_meshes)
            count += rigid.mesh.triangle_count() * rigid.count();
        for (const DeformingMesh& deforming : deforming_meshes)
            count += deforming.mesh.triangle_count();
        return count;
    }
};

} // namespace host
