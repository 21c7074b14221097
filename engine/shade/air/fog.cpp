#include "shade/air/fog.h"

#include <algorithm>

namespace peregrine::shade {

Fog::Fog(const scene::Fog& fog, const Kernels& kernels, const SurfaceSpace& space,
         const math::Vec3d& eye)
    : kernels_(&kernels), layer_{fog.density, float(fog.top - space.origin.y),
                                 float(fog.bottom - space.origin.y), 0, fog.color} {
    if (!any()) return;
    if (layer_.top > layer_.bottom) layer_.thinning = 1.0f / (layer_.top - layer_.bottom);
    std::fill_n(eye_heights_, kPadded, float(eye.y - space.origin.y));
}

} // namespace peregrine::shade
