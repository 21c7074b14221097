#pragma once

#include "query_contestant.h"

#include <memory>

namespace peregrine::bench {

// Bullet's collision world with the level as a static triangle mesh, without margins, one query a
// call. It has no nearest point. Throws where this build has no Bullet.
std::unique_ptr<QueryContestant> make_bullet_queries(const Level& level);

} // namespace peregrine::bench
