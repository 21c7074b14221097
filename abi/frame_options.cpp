#include "frame_options.h"

#include "check.h"
#include "read_array.h"
#include "shade/air/airlight.h"
#include "shade/occlusion/open_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace peregrine::abi {
namespace {

constexpr uint32_t kMostEdgeSamples = 16;
constexpr uint64_t kMostParticles = 1u << 24;

static_assert(sizeof(rt_particle) == 40);

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

void require_part(float part, const char* field) {
    if (!(part >= 0 && part <= 1))
        base::fail(base::Code::invalid_argument, "%s is %g; it must be 0 to 1", field,
                   double(part));
}

bool is_particle(const rt_particle& particle) {
    const auto is_good = [](float value) { return value >= 0 && std::isfinite(value); };
    return std::all_of(std::begin(particle.position), std::end(particle.position), is_coordinate)
           && is_good(particle.radius) && particle.radius > 0
           && std::all_of(std::begin(particle.color), std::end(particle.color), is_good);
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
    require_part(in.least_importance, "rt_frame_desc.least_importance");
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

render::Bloom to_bloom(const rt_frame_desc& in) {
    require_part(in.bloom, "rt_frame_desc.bloom");
    require_least_zero(in.bloom_threshold, "rt_frame_desc.bloom_threshold");
    require_part(in.bloom_radius, "rt_frame_desc.bloom_radius");
    return {in.bloom, in.bloom_threshold, in.bloom_radius};
}

void read_tail(const rt_frame_desc& in, render::Frame& frame) {
    if (in.airlight_shadows > shade::kMostPieces)
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.airlight_shadows is %u; it must be at most %u",
                   in.airlight_shadows, shade::kMostPieces);
    frame.airlight_pieces = in.airlight_shadows;
    const uint32_t block = std::max(in.airlight_block, 1u);
    if (block != 1 && block != 2 && block != 4)
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.airlight_block is %u; it must be 0, 1, 2 or 4", block);
    frame.airlight_block = block;
    require_flag(in.tinted_shadows, "rt_frame_desc.tinted_shadows");
    frame.tinted_shadows = in.tinted_shadows != 0;
    require_flag(in.baked_light, "rt_frame_desc.baked_light");
    frame.baked_light = in.baked_light != 0;
    require_flag(in.measure_luminance, "rt_frame_desc.measure_luminance");
    frame.measures_luminance = in.measure_luminance != 0;
}

base::Vector<render::Particle> to_particles(const rt_frame_desc& in, const double (&eye)[3],
                                            base::Memory* memory) {
    const Array<rt_particle> array(in.particles, "rt_frame_desc.particles", kMostParticles);
    base::Vector<render::Particle> out(memory);
    out.reserve(array.count());
    for (uint64_t i = 0; i < array.count(); ++i) {
        const rt_particle particle = array[i];
        if (!is_particle(particle))
            base::fail(base::Code::invalid_argument,
                       "rt_frame_desc.particles: particle %llu has a place that is not finite, a "
                       "radius that is not positive, or a negative colour",
                       static_cast<unsigned long long>(i));
        render::Particle& to = out.emplace_back();
        for (int k = 0; k < 3; ++k) {
            to.place[k] = float(particle.position[k] - eye[k]);
            to.color[k] = particle.color[k];
        }
        to.radius = particle.radius;
    }
    return out;
}

} // namespace peregrine::abi
