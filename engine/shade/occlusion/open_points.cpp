#include "shade/occlusion/open_points.h"

#include <algorithm>

namespace peregrine::shade {

void OpenPoints::aim(const OpenRay& ray, Surface::Lanes* direction) const {
    const auto& [x, y, z] = axis;
    const auto& [gx, gy, gz] = geometric;
    float* const dx = direction[0];
    float* const dy = direction[1];
    float* const dz = direction[2];
    for (int k = 0; k < 3; ++k)
        for (uint32_t i = 0; i < count; ++i)
            direction[k][i] =
                (x[k][i] * ray.direction.x + y[k][i] * ray.direction.y) + z[k][i] * ray.direction.z;
    for (uint32_t i = 0; i < count; ++i) {
        const float rise = (gx[i] * dx[i] + gy[i] * dy[i]) + gz[i] * dz[i];
        const float back = 2 * std::min(rise, 0.0f);
        dx[i] -= back * gx[i];
        dy[i] -= back * gy[i];
        dz[i] -= back * gz[i];
    }
}

} // namespace peregrine::shade
