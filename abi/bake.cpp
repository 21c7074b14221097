#include "render/bake/bake.h"

#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "require_snapshot.h"
#include "scene_table.h"
#include "shade/occlusion/open_rays.h"

namespace peregrine::abi {
namespace {

constexpr uint32_t kMostBounces = 8;

render::bake::Options to_options(const rt_bake_desc* desc) {
    const rt_bake_desc fields = desc ? read_struct(desc) : rt_default_bake_desc();
    render::bake::Options options;
    if (fields.samples > 0) {
        require_extent(fields.samples, shade::kMostOpenRays, "rt_bake_desc.samples");
        options.samples = fields.samples;
    }
    if (!(fields.occlusion_range >= 0))
        base::fail(base::Code::invalid_argument,
                   "rt_bake_desc.occlusion_range is %g; it must be at least 0",
                   double(fields.occlusion_range));
    options.range = fields.occlusion_range;
    if (fields.bounces > kMostBounces)
        base::fail(base::Code::limit, "rt_bake_desc.bounces is %u; at most %u are supported",
                   fields.bounces, kMostBounces);
    options.bounces = fields.bounces;
    require_least_zero(fields.spacing, "rt_bake_desc.spacing");
    if (fields.spacing > 0) options.spacing = fields.spacing;
    require_least_zero(fields.tolerance, "rt_bake_desc.tolerance");
    options.tolerance = fields.tolerance;
    if (fields.most_bytes > 0) options.most_bytes = fields.most_bytes;
    options.progress = {fields.progress, fields.progress_user};
    return options;
}

rt_bake_report to_report(const render::bake::Report& in) {
    rt_bake_report out = rt_default_bake_report();
    out.point_count = in.points;
    out.sampled_count = in.sampled;
    out.rays = in.rays;
    out.bytes = in.bytes;
    out.bake_ms = in.ms;
    return out;
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_bake_light(rt_scene scene, const rt_bake_desc* desc,
                        rt_bake_report* out_report) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        const Output output(out_report);
        const render::bake::Options options = to_options(desc);
        const auto pin = pin_snapshot(host.scene.snapshots, {});
        render::bake::Report report;
        host.scene.set_light_map(render::bake::bake(
            require_snapshot(pin), options, host.scene.scheduler, &host.scene.memory, report));
        output.write(to_report(report));
    });
}
