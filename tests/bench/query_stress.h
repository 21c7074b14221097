#pragma once

#include "query_race.h"

namespace peregrine::bench {

// Rays from inside closed meshes, exactly at their vertices and at the middles of their edges, in
// place and 2.3 km away. Whatever gets out was missed.
void race_leaks(QueryRace& race, size_t count);

// Lines of sight in a level that lies 10 to 10,000 km away. Wrong is what a contestant said
// differently at home: missed, if there it saw something.
void race_far(QueryRace& race, const TraceScene& scene, const QuerySet& sight);

// Sets of a level at a ten-thousandth of its size, beside the reference of the small level.
void race_small(QueryRace& race, const TraceScene& scene, const std::string& item,
                const QuerySet& set);

} // namespace peregrine::bench
