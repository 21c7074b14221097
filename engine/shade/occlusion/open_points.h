#pragma once

#include "shade/occlusion/open_rays.h"
#include "shade/surface/surface.h"

namespace peregrine::shade {

// Places that send rays out, each with the axes that these turn with.
struct alignas(64) OpenPoints {
    Surface::Lanes axis[3][3];   // across, along, and the normal
    Surface::Lanes geometric[3]; // the normal of its triangle
    uint32_t index[kPadded];     // in the batch
    uint32_t count;

    // Those of a batch's points for which wants(i) is true. Their places go to `origin`.
    template <class Wants>
    void list(const Surface& surface, uint32_t point_count, const Wants& wants,
              Surface::Lanes* origin) {
        count = 0;
        math::Vec3 last(0);
        TangentFrame frame(last);
        for (uint32_t i = 0; i < point_count; ++i) {
            if (!wants(i)) continue;
            const math::Vec3 normal(surface.normal[0][i], surface.normal[1][i],
                                    surface.normal[2][i]);
            if (normal != last) frame = TangentFrame(normal);
            last = normal;
            for (int k = 0; k < 3; ++k) {
                origin[k][count] = surface.position[k][i];
                geometric[k][count] = surface.geometric[k][i];
                axis[0][k][count] = frame.x[k];
                axis[1][k][count] = frame.y[k];
                axis[2][k][count] = normal[k];
            }
            index[count++] = i;
        }
    }

    // Where one of the rays of each of them goes. If normals are interpolated, that may be down
    // into its triangle, which mirrors it.
    void aim(const OpenRay& ray, Surface::Lanes* direction) const;
};

} // namespace peregrine::shade
