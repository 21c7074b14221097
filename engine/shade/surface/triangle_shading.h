#pragma once

#include "scene/snapshot.h"
#include "shade/surface/space.h"

#include <cstdint>

namespace peregrine::shade {

// A texture over one triangle: what the texture's transform makes of the three vertices.
struct TextureOnTriangle {
    const scene::Texture* texture = nullptr; // null: none
    math::Vec2 uv[3];
};

// All that shading wants to know of a triangle, gathered once for neighbouring rays that hit it.
struct TriangleShading {
    math::Vec3 vertex[3];
    math::Vec3 geometric;  // unit, toward the viewer
    math::Vec3 lift;       // added to positions: see surface_lift()
    bool smooth;           // has vertex normals
    math::Vec3 normal[3];  // if smooth
    math::Vec3 tangent[3]; // if normal_map
    float handedness;      // the bitangent is this times cross(normal, tangent)
    const scene::Material* material;
    float shininess = -1;     // of the material, if specular; it and ...
    float highlight_gain = 0; // ... highlight_gain() of it are kept from triangle to triangle
    TextureOnTriangle base_color;
    TextureOnTriangle normal_map;
    TextureOnTriangle emissive;
};

// Gathers what `features` (scene::Feature bits) ask for; the rest is left unset.
void gather(const scene::Snapshot& snapshot, uint32_t features, uint32_t triangle, bool back_face,
            const SurfaceSpace& space, TriangleShading& out);

} // namespace peregrine::shade
