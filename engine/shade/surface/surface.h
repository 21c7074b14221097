#pragma once

#include "math/box.h"
#include "shade/surface/material_look.h"

#include <cstdint>

namespace peregrine::shade {

inline constexpr uint32_t kBatch = 512; // rays shaded at a time: their shadow rays fill a beam
inline constexpr uint32_t kPadded = kBatch + 16; // vectors may write this far

// Neighbouring rays that hit the same side of one triangle, or nothing.
struct TriangleRun {
    uint32_t begin, end;
    bool relief = false; // it has a normal map
};

// What is asked about surfaces: what light wants to know, how they look, or both. `smooth` is
// geometry without normal maps.
enum class SurfacePart : uint32_t { all = 0, geometry = 1, colors = 2, smooth = 3 };
inline constexpr uint32_t kSurfaceParts = 4;

// What lies at the hits of a batch of rays, as separate arrays. A ray that missed has zero normals
// and so catches no light.
struct alignas(64) Surface {
    using Lanes = float[kPadded];

    // Of SurfacePart::geometry.
    Lanes position[3];  // in a SurfaceSpace, lifted off the surface: shadow rays begin here
    Lanes geometric[3]; // unit normal of the triangle, toward the viewer
    Lanes normal[3];    // unit shading normal
    Lanes bend;         // 1 / (geometric . normal)
    Lanes mirror[3];    // unit, the view mirrored by `normal`; it and ...
    Lanes shininess;    // ... this with kSpecular
    math::Box bounds;   // of the positions that were hit

    // Of SurfacePart::colors.
    Lanes albedo[3];
    Lanes specular[3]; // with kSpecular
    Lanes emissive[3]; // with kEmissive
    Lanes occlusion;   // what is left of ambient light; with kOcclusionTextures

    // On the way there. Of look.places: texture coordinates, and what a ray's pixel covers in them,
    // as the matrix whose eigenvalues are the squares of an ellipse's axes.
    struct Place {
        Lanes u, v;
        Lanes uu, uv, vv; // if RayHits has a footprint
    };
    Place places[MaterialLook::kMostPlaces];
    Lanes tangent[3]; // where there is a normal map: the interpolated one, and the sign of ...
    Lanes side;       // ... the bitangent

    uint32_t run_count;
    TriangleRun runs[kBatch];
};
static_assert(sizeof(Surface::Lanes) % 64 == 0);

} // namespace peregrine::shade
