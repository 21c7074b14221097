#pragma once

#include "peregrine/rt.h"
#include "query/query.h"

namespace peregrine::abi {

// What an rt_query_desc of today's layout says, in the engine's terms. All throw base::Error with a
// sentence that names the field. The count of rays is above 0 for all but the first.
query::Selection to_selection(const rt_query_desc& desc);
query::Rays to_rays(const rt_query_desc& desc);
query::Hits to_hits(const rt_query_desc& desc);
query::Strided<uint8_t> to_occluded(const rt_query_desc& desc);
query::Strided<uint32_t> to_counts(const rt_query_desc& desc);
query::HitLists to_hit_lists(const rt_query_desc& desc);
// Beside `count` hits; none if the host wants none.
query::Surfaces to_surfaces(const rt_query_desc& desc, uint64_t count);

} // namespace peregrine::abi
