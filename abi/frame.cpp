#include "render/frame.h"

#include "check.h"
#include "frame_options.h"
#include "guard.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"

#include <cmath>

namespace peregrine::abi {
namespace {

constexpr uint32_t kLargestFrame = 16384;
constexpr double kPi = 3.14159265358979323846;
constexpr double kParallel = 1e-6; // sine of the angle between forward and up

static_assert(RT_FORMAT_RGBA8_SRGB == int(render::PixelFormat::rgba8_srgb));
static_assert(RT_FORMAT_BGRA8_SRGB == int(render::PixelFormat::bgra8_srgb));
static_assert(RT_FORMAT_RGBA16F == int(render::PixelFormat::rgba16f));
static_assert(RT_FORMAT_RGBA32F == int(render::PixelFormat::rgba32f));
static_assert(RT_VIEW_OCCLUSION == int(render::View::occlusion));
static_assert(RT_TONE_NONE == int(render::ToneMapping::none));

math::Vec3d to_unit(const float (&v)[3]) {
    return glm::normalize(math::Vec3d(v[0], v[1], v[2]));
}

render::Camera to_camera(const rt_camera& in) {
    if (!(in.vertical_fov > 0 && double(in.vertical_fov) < kPi))
        base::fail(base::Code::invalid_argument,
                   "rt_camera.vertical_fov is %g; it must be between 0 and pi",
                   double(in.vertical_fov));
    require_position(in.position, "rt_camera.position");
    require_direction(in.forward, "rt_camera.forward");
    require_direction(in.up, "rt_camera.up");
    if (glm::length(glm::cross(to_unit(in.forward), to_unit(in.up))) < kParallel)
        base::fail(base::Code::invalid_argument, "rt_camera.up is parallel to rt_camera.forward");
    render::Camera camera;
    camera.vertical_fov = in.vertical_fov;
    camera.position = {in.position[0], in.position[1], in.position[2]};
    camera.forward = {in.forward[0], in.forward[1], in.forward[2]};
    camera.up = {in.up[0], in.up[1], in.up[2]};
    return camera;
}

bool is_float(rt_pixel_format format) {
    return format == RT_FORMAT_RGBA16F || format == RT_FORMAT_RGBA32F;
}

void check_format(const rt_frame_desc& in) {
    require_enum(in.format, RT_FORMAT_RGBA32F, "rt_frame_desc.format");
    if (in.format == RT_FORMAT_RGBA8_LINEAR)
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.format is RT_FORMAT_RGBA8_LINEAR, which is for textures only");
    require_enum(in.tone_mapping, RT_TONE_NONE, "rt_frame_desc.tone_mapping");
    if (in.tone_mapping == RT_TONE_NONE && !is_float(in.format))
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.tone_mapping is RT_TONE_NONE, but the format holds no radiance "
                   "above 1");
}

template <class Element>
render::Plane to_plane(Element* data, uint64_t row_stride, const rt_frame_desc& in,
                       const char* field, const char* stride_field, uint32_t elements = 1) {
    if (!data) return {};
    return {data, require_rows(data, row_stride, in.width * sizeof(Element) * elements, in.height,
                               field, stride_field)};
}

void read_planes(const rt_frame_desc& in, render::Frame& frame) {
    frame.depth = to_plane(in.depth, in.depth_row_stride, in, "rt_frame_desc.depth",
                           "rt_frame_desc.depth_row_stride");
    frame.triangle_ids =
        to_plane(in.triangle_ids, in.triangle_row_stride, in, "rt_frame_desc.triangle_ids",
                 "rt_frame_desc.triangle_row_stride");
    frame.mesh_ids = to_plane(in.mesh_ids, in.mesh_row_stride, in, "rt_frame_desc.mesh_ids",
                              "rt_frame_desc.mesh_row_stride");
    frame.normals = to_plane(in.normals, in.normal_row_stride, in, "rt_frame_desc.normals",
                             "rt_frame_desc.normal_row_stride", 3);
    if (!in.pixels && !frame.wants_planes())
        base::fail(base::Code::invalid_argument,
                   "rt_frame_desc.pixels is null, and no other plane is asked for");
}

render::Frame to_frame(const rt_frame_desc& in) {
    check_format(in);
    require_extent(in.width, kLargestFrame, "rt_frame_desc.width");
    require_extent(in.height, kLargestFrame, "rt_frame_desc.height");
    require_enum(in.view, RT_VIEW_OCCLUSION, "rt_frame_desc.view");
    require_positive(in.exposure, "rt_frame_desc.exposure");
    require_positive(in.depth_range, "rt_frame_desc.depth_range");
    require_positive(in.steps_range, "rt_frame_desc.steps_range");
    require_flag(in.no_shadows, "rt_frame_desc.no_shadows");
    render::Frame frame;
    frame.format = render::PixelFormat(in.format);
    frame.pixels = in.pixels;
    read_planes(in, frame);
    if (in.pixels)
        frame.row_stride =
            require_rows(in.pixels, in.row_stride, in.width * render::bytes_per_pixel(frame.format),
                         in.height, "rt_frame_desc.pixels", "rt_frame_desc.row_stride");
    frame.width = in.width;
    frame.height = in.height;
    frame.view = render::View(in.view);
    frame.tone_mapping = render::ToneMapping(in.tone_mapping);
    frame.exposure = in.exposure;
    frame.depth_range = in.depth_range;
    frame.steps_range = in.steps_range;
    frame.shadows = in.no_shadows == 0;
    frame.approximations = to_approximations(in);
    frame.bounces = to_bounces(in);
    frame.occlusion = to_occlusion(in);
    frame.bloom = to_bloom(in);
    read_tail(in, frame);
    return frame;
}

rt_frame_stats to_stats(const render::FrameStats& in) {
    rt_frame_stats out = rt_default_frame_stats();
    out.threads = in.threads;
    out.rays_primary = in.rays_primary;
    out.rays_shadow = in.rays_shadow;
    out.rays_edge = in.rays_edge;
    out.light_points = in.light_points;
    out.rays_bounced = in.rays_bounced;
    out.rays_occlusion = in.rays_occlusion;
    out.occlusion_points = in.occlusion_points;
    out.rays_particle = in.rays_particle;
    out.program_hits = in.program_hits;
    out.program_faults = in.program_faults;
    out.mean_luminance = double(in.mean_luminance);
    out.frame_ms = in.frame_ms;
    out.isa = rt_isa(in.isa);
    return out;
}

render::FrameStats render(scene::Scene& scene, render::Camera camera, const render::Frame& frame,
                          rt_snapshot held) {
    const auto pin = pin_snapshot(scene.snapshots, held);
    const scene::Snapshot& snapshot = require_snapshot(pin, held);
    camera.position -= snapshot.origin;
    render::FrameStats stats;
    render::render_frame(snapshot, camera, frame, scene.scheduler, &scene.frame_memory, &stats);
    return stats;
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine::abi;

rt_result rt_render_frame(rt_scene scene, const rt_camera* camera, const rt_frame_desc* frame,
                          rt_frame_stats* out_stats) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        const Output output(out_stats);
        const rt_camera view = read_struct(camera);
        const auto engine_camera = to_camera(view);
        const rt_frame_desc fields = read_struct(frame);
        auto engine_frame = to_frame(fields);
        const auto particles = to_particles(fields, view.position, &host.scene.frame_memory);
        engine_frame.particles = particles;
        output.write(to_stats(render(host.scene, engine_camera, engine_frame, fields.snapshot)));
    });
}
