#pragma once

#include "query/records.h"
#include "scene/snapshot.h"

#include <cstddef>
#include <cstring>

namespace peregrine::query {

// Whose triangle it is, in the host's terms.
struct HitIds {
    uint32_t triangle;
    base::Handle mesh;
};

// What it takes to name triangles, kept at hand for a batch.
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

private:
    const trace::World& world_;
    const uint32_t* generations_;
};

// Eight bytes at a time to where the host wants them: a record put together elsewhere and copied
// would wait for its own stores.
inline void store_hit(float t, float u, float v, const HitIds& ids, uint32_t back_face,
                      std::byte* place) {
    const auto store = [place](size_t offset, auto low, auto high) {
        static_assert(sizeof low == 4 && sizeof high == 4);
        const uint64_t both =
            std::bit_cast<uint32_t>(low) | uint64_t(std::bit_cast<uint32_t>(high)) << 32;
        std::memcpy(place + offset, &both, sizeof both);
    };
    static_assert(offsetof(Hit, v) == 8 && offsetof(Hit, mesh) == 16);
    store(0, t, u);
    store(8, v, ids.triangle);
    store(16, ids.mesh.index, ids.mesh.generation);
    store(24, uint32_t(0), back_face);
}

} // namespace peregrine::query
