#pragma once

#include "gameplay/three_cores/floors.h"

namespace peregrine::three_cores {

// How far it is to walk from one place to every other; infinity where no way leads. Metres, a
// little more along walls.
std::vector<double> distances_from(const Floors& floors, uint32_t from);

// The shortest way, both ends included; empty if there is none. A* of Hart, Nilsson and Raphael,
// "A formal basis for the heuristic determination of minimum cost paths" (1968).
std::vector<uint32_t> find_way(const Floors& floors, uint32_t from, uint32_t to);

// The same between the places nearest to two points (Floors::nearest): points of the floor, about
// half a metre apart.
std::vector<Vec3> find_way(const Floors& floors, const Vec3& from, const Vec3& to);

} // namespace peregrine::three_cores
