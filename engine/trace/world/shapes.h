#pragma once

#include "trace/shapes/shapes.h"
#include "trace/world/world.h"

// Shapes in all parts of a world. By definition, triangles of an instance are taken to the world in
// double and tested there; its structure only says which ones. Volumes are those in the world.
namespace peregrine::trace {

// Triangles are numbered through, as by closest().
FirstHit sweep(const World& world, const Volume& volume, const SweepQuery& query);
bool overlaps(const World& world, const Volume& volume, const OverlapQuery& query);
void collect(const World& world, const Volume& volume, const OverlapQuery& query, Touched& touched);
NearestHit nearest(const World& world, const Volume& volume, const NearestQuery& query);

} // namespace peregrine::trace
