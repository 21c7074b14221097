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

// Throws base::Error if a hit names a mesh that the snapshot lacks or a triangle that the mesh
// lacks; nothing is written then. A miss resolves to zeros.
void resolve(const scene::Snapshot& snapshot, const Strided<Hit>& hits,
             const Strided<Surface>& surfaces);

} // namespace peregrine::query
