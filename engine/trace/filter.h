#pragma once

#include "geometry/triangle.h"

#include <cstdint>

namespace peregrine::trace {

enum class Faces : uint32_t { both = 0, front = 1, back = 2 };

// Asks whether the surface of a kMasked triangle is present at (u, v).
struct AlphaTest {
    bool (*present)(const void* context, const geometry::Triangle& triangle, float u,
                    float v) = nullptr; // null: always
    const void* context = nullptr;
};

// Which triangles a ray may hit, beyond their geometry.
struct Filter {
    Faces faces = Faces::both;
    bool cull_single_sided = false; // the backs of kSingleSided triangles do not count
    uint32_t layer_mask = ~0u;
    uint32_t ignore_mesh = geometry::kNoTriangle; // a slot
    const uint32_t* layer_masks = nullptr;        // by slot of the mesh
    AlphaTest alpha;

    // Nothing to ask: the kernels then run their shorter variant.
    bool trivial() const {
        return faces == Faces::both && !cull_single_sided && layer_mask == ~0u
               && ignore_mesh == geometry::kNoTriangle && !alpha.present;
    }

    bool accepts(const geometry::Triangle& triangle, bool back_face, float u, float v) const {
        if (back_face ? faces == Faces::front : faces == Faces::back) return false;
        if (back_face && cull_single_sided && (triangle.flags & geometry::kSingleSided))
            return false;
        if (triangle.mesh == ignore_mesh) return false;
        if (layer_mask != ~0u && !(layer_masks[triangle.mesh] & layer_mask)) return false;
        return !(triangle.flags & geometry::kMasked) || !alpha.present
               || alpha.present(alpha.context, triangle, u, v);
    }
};

} // namespace peregrine::trace
