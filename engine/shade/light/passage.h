#pragma once

#include "scene/snapshot.h"
#include "trace/world/position.h"

namespace peregrine::shade {

// What is left of light, 0 to 1 in each colour, on the straight way of a ray that meets nothing
// opaque: as of rays that go on in frames (path/split-inl.h), but that none is bent. A surface lets
// through what it does not cover, does not mirror, and is not black to. Fresnel's equations take
// the side with the smaller index, whichever way the ray goes: bent light would leave a slab as it
// came. Between hulls of solids Beer's law counts. `filter`: which surfaces are present.
math::Vec3 passage(const scene::Snapshot& snapshot, const trace::Filter& filter,
                   const math::Ray& ray, const trace::Position& position);

} // namespace peregrine::shade
