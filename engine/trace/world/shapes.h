#pragma once

#include "trace/shapes/shapes.h"
#include "trace/world/world.h"

// Shapes in all parts of a world. By definition, triangles of an instance are turned as in the
// world and put before the shape's centre in double, and tested there; its structure only says
// which ones. Volumes are those in the world; the position is that of their origin.
namespace peregrine::trace {

// Triangles are numbered through, as by closest().
FirstHit sweep(const World& world, const Volume& volume, const Position& position,
               const SweepQuery& query);
// ... of a shape that slides (geometry/shapes/slide.h).
FirstHit slide(const World& world, const Volume& volume, const Position& position,
               const SweepQuery& query);
bool overlaps(const World& world, const Volume& volume, const Position& position,
              const OverlapQuery& query);
void collect(const World& world, const Volume& volume, const Position& position,
             const OverlapQuery& query, Touched& touched);
NearestHit nearest(const World& world, const Volume& volume, const Position& position,
                   const NearestQuery& query);

} // namespace peregrine::trace
