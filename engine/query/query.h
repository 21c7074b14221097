#pragma once

#include "base/slot_map.h"
#include "math/ray.h"
#include "scene/snapshot.h"
#include "trace/filter.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace peregrine::query {

// Records of the host, `stride` bytes apart, aligned as they may be.
template <class Record>
struct Strided {
    std::byte* data;
    uint64_t count;
    uint32_t stride;

    Record load(uint64_t i) const {
        Record record;
        std::memcpy(&record, data + i * stride, sizeof record);
        return record;
    }
    void store(uint64_t i, const Record& record) const {
        std::memcpy(data + i * stride, &record, sizeof record);
    }
};

// A hit as it leaves the library: the layout of rt_hit.
struct Hit {
    float t, u, v;
    uint32_t triangle; // the host's own index; kNoTriangle for a miss
    base::Handle mesh;
    uint32_t instance;
    uint32_t back_face;
};
static_assert(sizeof(Hit) == 32);

// Which triangles count, in the host's terms.
struct Selection {
    trace::Faces faces = trace::Faces::both;
    uint32_t layer_mask = ~0u;
    base::Handle ignore_mesh;
    bool alpha_test = false;
};

// One ray that may hit anything: the short way. Check the ray first; `place` takes a Hit.
void check_ray(const math::Ray& ray);
void closest_hit(const scene::Snapshot& snapshot, const math::Ray& ray, std::byte* place);
bool occluded(const scene::Snapshot& snapshot, const math::Ray& ray);

// Throws base::Error invalid_argument that names the first ray which is not one: a component NaN,
// an origin infinite or beyond 1e30, a direction infinite or zero.
void check_rays(const Strided<math::Ray>& rays);

void closest_hits(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
                  const Selection& selection, const Strided<Hit>& hits);
void occlusion(const scene::Snapshot& snapshot, const Strided<math::Ray>& rays,
               const Selection& selection, const Strided<uint8_t>& occluded);

} // namespace peregrine::query
