#pragma once

#include "base/slot_map.h"
#include "math/vec.h"
#include "query/records.h"
#include "scene/snapshot.h"

#include <cstdint>

namespace peregrine::query {

// What lies at a hit: the layout of rt_surface.
struct Surface {
    math::Vec3d position{0};
    math::Vec3 geometric_normal{0};
    math::Vec3 shading_normal{0};
    math::Vec2 texcoord{0};
    base::Handle material;
    uint64_t material_user_data = 0;
    uint64_t mesh_user_data = 0;
};
static_assert(sizeof(Surface) == 80);

// What of it is wanted; the rest is 0 and takes no time.
enum SurfaceField : uint32_t {
    kPosition = 1u << 0,
    kGeometricNormal = 1u << 1,
    kShadingNormal = 1u << 2,
    kTexcoord = 1u << 3,
    kMaterial = 1u << 4,
    kUserData = 1u << 5, // of the material and of the mesh
    kAllFields = (1u << 6) - 1,
};

// Where surfaces go; null: nowhere.
struct Surfaces {
    std::byte* data = nullptr;
    uint32_t stride = 0;
    uint32_t fields = kAllFields;

    explicit operator bool() const { return data != nullptr; }
    void store(uint64_t i, const Surface& surface) const {
        std::memcpy(data + i * stride, &surface, sizeof surface);
    }
};

// Throws base::Error if a hit names a mesh that the snapshot lacks or a triangle that the mesh
// lacks; nothing is written then. Or marks its surface (marks.h). A miss resolves to zeros.
// Positions are relative to `origin`.
void resolve(const scene::Snapshot& snapshot, const Strided<Hit>& hits, const Surfaces& surfaces,
             const math::Vec3d& origin = math::Vec3d(0), bool mark_invalid = false);

// ... of a hit that the snapshot gave, or of a miss.
Surface surface_at(const scene::Snapshot& snapshot, const Hit& hit, uint32_t fields,
                   const math::Vec3d& origin = math::Vec3d(0));

} // namespace peregrine::query
