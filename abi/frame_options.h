#pragma once

#include "peregrine/rt.h"
#include "render/frame.h"

namespace peregrine::abi {

// Checked. `in.width` and `in.height` have been.
render::Approximations to_approximations(const rt_frame_desc& in);
render::Bounces to_bounces(const rt_frame_desc& in);
render::Bloom to_bloom(const rt_frame_desc& in);

} // namespace peregrine::abi
