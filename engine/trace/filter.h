#pragma once

#include "geometry/triangle.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace peregrine::trace {

enum class Faces : uint32_t { both = 0, front = 1, back = 2 };

// Asks whether the surface of a kMasked triangle is present at (u, v).
struct AlphaTest {
    bool (*present)(const void* context, const geometry::TriangleInfo& triangle, float u,
                    float v) = nullptr; // null: always
    const void* context = nullptr;
};

// Which of its tests an instance takes in the place of Filter::alpha.
enum class Asks : uint32_t { presence, light, opacity };
inline constexpr uint32_t kAsks = 3;

// Which triangles a ray may hit, beyond their geometry.
struct Filter {
    Faces faces = Faces::both;
    bool cull_single_sided = false; // the backs of kSingleSided triangles do not count
    Asks asks = Asks::presence;
    uint32_t layer_mask = ~0u;
    uint32_t ignore_mesh = geometry::kNoTriangle; // a slot
    std::span<const uint32_t> ignore_more;        // slots, ascending; none without ignore_mesh
    const uint32_t* layer_masks = nullptr;        // by slot of the mesh
    AlphaTest alpha;

    // Nothing to ask: the kernels then run their shorter variant.
    bool trivial() const {
        return faces == Faces::both && !cull_single_sided && layer_mask == ~0u
               && ignore_mesh == geometry::kNoTriangle && !alpha.present;
    }

    bool ignores(uint32_t mesh) const {
        return mesh == ignore_mesh
               || (!ignore_more.empty() && std::ranges::binary_search(ignore_more, mesh));
    }
    bool sees_mesh(const geometry::TriangleInfo& triangle) const {
        return !ignores(triangle.mesh)
               && (layer_mask == ~0u || (layer_masks[triangle.mesh] & layer_mask) != 0);
    }
    bool sees_front() const { return faces != Faces::back; }
    bool sees_back(const geometry::TriangleInfo& triangle) const {
        return faces != Faces::front
               && !(cull_single_sided && (triangle.flags & geometry::kSingleSided));
    }
    bool asks_alpha(const geometry::TriangleInfo& triangle) const {
        return alpha.present && (triangle.flags & geometry::kMasked);
    }
    // Wherever it is hit, and from both sides.
    bool accepts_all(const geometry::TriangleInfo& triangle) const {
        return sees_front() && sees_back(triangle) && sees_mesh(triangle) && !asks_alpha(triangle);
    }

    bool accepts(const geometry::TriangleInfo& triangle, bool back_face, float u, float v) const {
        return (back_face ? sees_back(triangle) : sees_front()) && sees_mesh(triangle)
               && (!asks_alpha(triangle) || alpha.present(alpha.context, triangle, u, v));
    }
};

} // namespace peregrine::trace
