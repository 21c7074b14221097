#pragma once

#include "level.h"
#include "trace_rays.h"

#include <cstdint>
#include <span>

namespace peregrine::bench {

// The primary rays of frames, a batch a view, in the order that RaySet says.
RaySet make_primary_rays(std::span<const host::Viewpoint> views, uint32_t width, uint32_t height);

} // namespace peregrine::bench
