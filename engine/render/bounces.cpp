#include "render/bounces.h"

#include "render/shading.h"
#include "trace/world/single.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::render {
namespace {

// `light` fills scratch.light once the surfaces are known. `openness`: of the rays, or null.
template <class Light>
void shade_and_follow(const Plan& plan, TileBuffers& buffers, uint32_t count, float footprint,
                      const float* openness, const Light& light) {
    shade::PathMemory& memory = *buffers.paths;
    shade::Scratch& scratch = buffers.scratch;
    float* const colors[3] = {buffers.colors.channel[0], buffers.colors.channel[1],
                              buffers.colors.channel[2]};
    buffers.for_each_batch(count, [&](shade::RayHits hits, uint32_t first) {
        hits.footprint *= footprint;
        plan.shader.take_surroundings(hits, openness ? openness + first : nullptr, scratch);
        plan.shader.find_surfaces(hits, shade::SurfacePart::all, scratch);
        plan.paths.split(hits, memory, scratch);
        light(hits, first);
        const TileBuffers::Channels radiance = buffers.colors_from(first);
        const shade::AskedRays asked = plan.paths.asked_rays(memory);
        plan.shader.find_radiance(hits, radiance.channel, scratch, &asked);
        if (plan.shader.has_sky()) plan.shader.paint_sky(hits, radiance.channel);
        plan.paths.keep(hits, colors, first, memory, scratch);
    });
    plan.paths.follow(colors, memory, scratch);
}

} // namespace

PathRoom::PathRoom(const Plan& plan, size_t threads, base::Memory* memory)
    : memory_(plan.paths.any() ? threads : 0, memory),
      chunks_(memory_.size() * plan.paths.chunk_count(), memory) {}

shade::PathMemory* PathRoom::memory(const Plan& plan, size_t thread) {
    if (memory_.empty()) return nullptr;
    plan.paths.begin(chunks_.data() + thread * plan.paths.chunk_count(), memory_[thread]);
    return &memory_[thread];
}

uint64_t PathRoom::ray_count() const {
    uint64_t count = 0;
    for (const shade::PathMemory& memory : memory_) count += memory.ray_count;
    return count;
}

shade::Media media_at(const scene::Snapshot& snapshot, const math::Vec3d& eye,
                      const math::Vec3& forward, const trace::Filter& filter) {
    constexpr uint32_t kMostCrossings = 256;
    shade::Media entered; // along the ray
    uint32_t left[shade::Media::kMost];
    uint32_t left_count = 0;
    math::Ray ray = {math::Vec3(eye), 0.0f, forward, std::numeric_limits<float>::infinity()};
    for (uint32_t i = 0; i < kMostCrossings && left_count < shade::Media::kMost; ++i) {
        const trace::Hit hit = trace::closest(snapshot.world, ray, {math::Vec3(0), eye}, filter);
        if (hit.triangle == geometry::kNoTriangle) break;
        ray.t_min = std::nextafter(hit.t, std::numeric_limits<float>::infinity());
        const geometry::TriangleInfo info = trace::info(snapshot.world, hit.triangle);
        const uint32_t material = snapshot.meshes[info.mesh].materials->of(info.primitive);
        if (!snapshot.material_set->materials[material].is_solid()) continue;
        if (!hit.back_face)
            entered.enter(material);
        else if (entered.holds(material))
            entered.leave(material);
        else
            left[left_count++] = material;
    }
    shade::Media media;
    while (left_count > 0) media.enter(left[--left_count]); // the first to be left is the innermost
    return media;
}

void shade_rays_and_follow(const Plan& plan, TileBuffers& buffers, uint32_t count, float footprint,
                           const float* openness) {
    const bool keeps_light = plan.frame.looks_for_edges();
    shade_and_follow(plan, buffers, count, footprint, openness,
                     [&](const shade::RayHits& hits, uint32_t first) {
                         plan.shader.gather_light(hits, buffers.scratch, nullptr);
                         if (keeps_light) keep_light(hits, first, buffers);
                     });
}

void shade_tile_and_follow(const Plan& plan, TileBuffers& buffers) {
    shade_rays_and_follow(plan, buffers, buffers.tile.count, 1, buffers.openness_from(0));
    buffers.light_point_count += buffers.tile.count;
}

void shade_blocks_and_follow(const Plan& plan, TileBuffers& buffers) {
    find_light(plan, buffers);
    shade_and_follow(plan, buffers, buffers.tile.count, 1, buffers.openness_from(0),
                     [&](const shade::RayHits& hits, uint32_t first) {
                         take_light(plan, hits, first, buffers);
                     });
}

} // namespace peregrine::render
