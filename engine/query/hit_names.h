#pragma once

#include "query/records.h"
#include "scene/snapshot.h"
#include "trace/world/hit_list.h"

namespace peregrine::query {

// Whose triangle it is, in the host's terms.
struct HitIds {
    uint32_t triangle;
    base::Handle mesh;
};

// What it takes to put hits into the host's terms, kept at hand for a batch.
class HitNames {
public:
    explicit HitNames(const scene::Snapshot& snapshot)
        : world_(snapshot.world), generations_(snapshot.generations.data()) {}

    HitIds of(uint32_t triangle) const {
        if (triangle == geometry::kNoTriangle) return {geometry::kNoTriangle, {}};
        const geometry::TriangleInfo info = trace::info(world_, triangle);
        return {info.primitive, mesh(info.mesh)};
    }
    base::Handle mesh(uint32_t slot) const { return {slot, generations_[slot]}; }

    Hit hit(const trace::Hit& found) const {
        const HitIds ids = of(found.triangle);
        return {found.t, found.u, found.v, ids.triangle, ids.mesh, 0, found.back_face};
    }
    Hit hit(const trace::WorldHit& found) const {
        return {found.t, found.u, found.v, found.primitive, mesh(found.mesh), 0, found.back_face};
    }
    Hit hit(const trace::HitStream& found, uint32_t i) const {
        const HitIds ids = of(found.triangle[i]);
        return {found.t[i], found.u[i], found.v[i], ids.triangle, ids.mesh, 0, found.back_face[i]};
    }

private:
    const trace::World& world_;
    const uint32_t* generations_;
};

} // namespace peregrine::query
