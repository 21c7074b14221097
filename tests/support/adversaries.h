#pragma once

#include "support/world.h"

// Triangles that builders and traversals find hard.
namespace peregrine::test {

//   +--+--+--+   Every vertex, edge and face of them on a lattice, in layers along all three axes:
//   |\ |\ |\ |   splits fall on faces, rays run inside planes, and much is equally far away.
//   | \| \| \|
//   +--+--+--+
std::vector<geometry::Triangle> lattice();

// All around one place, many the same.
std::vector<geometry::Triangle> coincident(int count);

// Each from both sides: triangles and their like turned over, in any order.
std::vector<geometry::Triangle> two_sided(int count);

// 1e7 times as long as wide, through each other at one place.
std::vector<geometry::Triangle> needles(int count);

} // namespace peregrine::test
