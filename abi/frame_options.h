#pragma once

#include "peregrine/rt.h"
#include "render/frame.h"

namespace peregrine::abi {

// Checked. `in.width` and `in.height` have been.
render::Approximations to_approximations(const rt_frame_desc& in);
render::Bounces to_bounces(const rt_frame_desc& in);
render::Occlusion to_occlusion(const rt_frame_desc& in);
render::Bloom to_bloom(const rt_frame_desc& in);
// Airlight, and what is measured.
void read_tail(const rt_frame_desc& in, render::Frame& frame);

// `eye`: rt_camera.position.
base::Vector<render::Particle> to_particles(const rt_frame_desc& in, const double (&eye)[3],
                                            base::Memory* memory);

} // namespace peregrine::abi
