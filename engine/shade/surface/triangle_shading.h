#pragma once

#include "scene/snapshot.h"
#include "shade/surface/material_look.h"
#include "shade/surface/space.h"

#include <cstdint>

namespace peregrine::shade {

// All that shading wants to know of a triangle, gathered once for neighbouring rays that hit it.
struct TriangleShading {
    math::Vec3 vertex[3];
    math::Vec3 geometric;  // unit, toward the viewer
    math::Vec3 lift;       // added to positions: see surface_lift()
    bool smooth;           // has vertex normals
    math::Vec3 normal[3];  // if smooth
    math::Vec3 tangent[3]; // if look.normal
    float handedness;      // the bitangent is this, 1 or -1, times cross(normal, tangent)
    MaterialLook look;
    math::Vec2 texcoord[MaterialLook::kMostPlaces]
                       [3]; // of look.places: what their transforms make of the three vertices
};

// Gathers what `features` (scene::Feature bits) ask for; the rest is left unset.
void gather(const scene::Snapshot& snapshot, uint32_t features, uint32_t triangle, bool back_face,
            const SurfaceSpace& space, TriangleShading& out);

} // namespace peregrine::shade
