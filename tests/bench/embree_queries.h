#pragma once

#include "query_contestant.h"

#include <memory>

namespace peregrine::bench {

// Embree at its best quality, one query a call, with or without its flag for fewer leaks. It has no
// sweeps and no overlaps. Throws where this build has no Embree.
std::unique_ptr<QueryContestant> make_embree_queries(const Level& level, bool robust);

} // namespace peregrine::bench
