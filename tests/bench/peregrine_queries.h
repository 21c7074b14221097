#pragma once

#include "query_contestant.h"

#include <memory>

namespace peregrine::bench {

// The engine through its header, one query a call or a whole set.
std::unique_ptr<QueryContestant> make_peregrine_queries(const rt_api& api, const Level& level,
                                                        bool whole_sets);

} // namespace peregrine::bench
