#include "frame_options.h"

#include "check.h"
#include "shade/occlusion/open_rays.h"

namespace peregrine::abi {
namespace {

constexpr uint32_t kMostEdgeSamples = 16;

static_assert(RT_TEXTURE_FINEST == int(render::TextureFilter::finest));
static_assert(RT_TEXTURE_MIPMAPS == int(render::TextureFilter::mipmaps));

uint32_t to_block(uint32_t block, const char* field) {
    if (block > 1 && block != 4 && block != 8 && block != 16)
        base::fail(base::Code::invalid_argument, "%s is %u; it must be 0, 1, 4, 8 or 16", field,
                   block);
    return std::max(block, 1u);
}

uint32_t to_side(uint32_t side, uint32_t whole, const char* field) {
    if (side > whole)
        base::fail(base::Code::invalid_argument, "%s is %u, which is more than the frame's %u",
                   field, side, whole);
    return side == 0 ? whole : side;
}

} // namespace

render::Approximations to_approximations(const rt_frame_desc& in) {
    render::Approximations out;
    out.light_block = to_block(in.light_block, "rt_frame_desc.light_block");
    require_least_zero(in.light_tolerance, "rt_frame_desc.light_tolerance");
    out.light_tolerance = in.light_tolerance;
    require_enum(in.texture_filter, RT_TEXTURE_MIPMAPS, "rt_frame_desc.texture_filter");
    out.texture_filter = render::TextureFilter(in.texture_filter);
    require_least_zero(in.least_light, "rt_frame_desc.least_light");
    out.least_light = in.least_light;
    if (in.edge_samples > 1)
        require_extent(in.edge_samples, kMostEdgeSamples, "rt_frame_desc.edge_samples");
    out.edge_samples = std::max(in.edge_samples, 1u);
    require_least_zero(in.edge_budget, "rt_frame_desc.edge_budget");
    out.edge_budget = in.edge_budget;
    out.render_width = to_side(in.render_width, in.width, "rt_frame_desc.render_width");
    out.render_height = to_side(in.render_height, in.height, "rt_frame_desc.render_height");
    return out;
}

render::Bounces to_bounces(const rt_frame_desc& in) {
    if (in.max_depth > render::kMostDepth)
        base::fail(base::Code::limit, "rt_frame_desc.max_depth is %u; at most %u is supported",
                   in.max_depth, render::kMostDepth);
    if (!(in.least_importance >= 0 && in.least_importance <= 1))
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.least_importance is %g; it must be 0 to 1",
                   double(in.least_importance));
    return {in.max_depth, in.least_importance};
}

render::Occlusion to_occlusion(const rt_frame_desc& in) {
    render::Occlusion out;
    if (!(in.occlusion_range >= 0))
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.occlusion_range is %g; it must be at least 0",
                   double(in.occlusion_range));
    out.range = in.occlusion_range;
    if (in.occlusion_samples > 0) {
        require_extent(in.occlusion_samples, shade::kMostOpenRays,
                       "rt_frame_desc.occlusion_samples");
        out.samples = in.occlusion_samples;
    }
    out.block = to_block(in.occlusion_block, "rt_frame_desc.occlusion_block");
    require_least_zero(in.occlusion_tolerance, "rt_frame_desc.occlusion_tolerance");
    out.tolerance = in.occlusion_tolerance;
    require_least_zero(in.occlusion_normal_tolerance, "rt_frame_desc.occlusion_normal_tolerance");
    out.normal_tolerance = in.occlusion_normal_tolerance;
    require_least_zero(in.occlusion_plane_tolerance, "rt_frame_desc.occlusion_plane_tolerance");
    out.plane_tolerance = in.occlusion_plane_tolerance;
    return out;
}

} // namespace peregrine::abi
