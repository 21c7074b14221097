#include "render/bake/sampler.h"

#include "scene/alpha_test.h"

#include <algorithm>

namespace peregrine::render::bake {
namespace {

constexpr uint32_t kProbes = 8;
constexpr float kPixel = 0.3f; // how wide one ray of 64 in half a sphere is at a distance of 1

} // namespace

Sampler::Sampler(const scene::Snapshot& fixed, const shade::Shader& shader)
    : fixed_(fixed), shader_(shader) {
    filter_.alpha = scene::light_test(fixed);
    filter_.asks = trace::Asks::light;
}

shade::RayHits Sampler::hits_of(const SamplerMemory& memory, uint32_t count, float footprint) {
    return {{memory.direction[0], memory.direction[1], memory.direction[2]},
            memory.u,
            memory.v,
            memory.triangle,
            memory.back_face,
            memory.t,
            count,
            footprint};
}

shade::RayHits Sampler::place(std::span<const Place> places, SamplerMemory& memory) const {
    const auto count = uint32_t(places.size());
    for (uint32_t i = 0; i < count; ++i) {
        memory.u[i] = places[i].u;
        memory.v[i] = places[i].v;
        memory.t[i] = 1;
        memory.triangle[i] = places[i].triangle;
        memory.back_face[i] = 0;
        memory.direction[0][i] = memory.direction[1][i] = 0;
        memory.direction[2][i] = 1;
        memory.behind[i] = 0;
    }
    const shade::RayHits hits = hits_of(memory, count, 0);
    shader_.find_surfaces(hits, shade::SurfacePart::smooth, memory.scratch);
    memory.points.list(
        memory.scratch.surface, count, [](uint32_t) { return true; }, memory.origin);
    return hits;
}

shade::RayHits Sampler::trace(const shade::OpenRay& ray, SamplerMemory& memory) const {
    const uint32_t count = memory.points.count;
    memory.points.aim(ray, memory.direction);
    const trace::RayStream rays = {{memory.origin[0], memory.origin[1], memory.origin[2]},
                                   {memory.direction[0], memory.direction[1], memory.direction[2]},
                                   memory.scratch.shadow.zeros,
                                   memory.scratch.shadow.infinities,
                                   count,
                                   trace::Coherence::incoherent};
    const trace::Part& fixed = fixed_.world.fixed;
    fixed.kernels->closest_stream(
        fixed.target, rays, filter_,
        {memory.t, memory.u, memory.v, memory.triangle, memory.back_face, nullptr});
    memory.ray_count += count;
    for (uint32_t i = 0; i < count; ++i) {
        if (memory.triangle[i] == geometry::kNoTriangle || !memory.back_face[i]) continue;
        if (!(fixed.target.infos[memory.triangle[i]].flags & geometry::kSingleSided)) continue;
        ++memory.behind[i];
        memory.triangle[i] = geometry::kNoTriangle;
    }
    return hits_of(memory, count, kPixel);
}

OpennessSampler::OpennessSampler(const scene::Snapshot& fixed, const shade::Shader& shader,
                                 float range, uint32_t samples)
    : Sampler(fixed, shader), openness_(fixed, shader.space(), range, samples),
      probes_(kProbes, false) {}

void OpennessSampler::sample(std::span<const Place> places, SamplerMemory& memory,
                             Sample* const* out) const {
    const shade::RayHits hits = place(places, memory);
    float* const open = memory.radiance[0];
    std::fill_n(open, hits.count, -1.0f);
    openness_.find(hits, memory.scratch.surface, memory.scratch.shadow, memory.openness, open);
    for (const shade::OpenRay& ray : probes_.all()) trace(ray, memory);
    for (uint32_t i = 0; i < hits.count; ++i)
        *out[i] = {open[i], math::Vec3(0), 2 * memory.behind[i] > kProbes};
}

void LightSampler::sample(std::span<const Place> places, SamplerMemory& memory,
                          Sample* const* out) const {
    place(places, memory);
    const auto count = uint32_t(places.size());
    for (auto& channel : memory.sum) std::fill_n(channel, count, 0.0f);
    float* const radiance[3] = {memory.radiance[0], memory.radiance[1], memory.radiance[2]};
    for (const shade::OpenRay& ray : rays_.all()) {
        shader_.shade(trace(ray, memory), radiance, memory.scratch);
        for (int k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < count; ++i) memory.sum[k][i] += radiance[k][i];
    }
    const auto samples = uint32_t(rays_.all().size());
    const float part = 1.0f / float(samples);
    for (uint32_t i = 0; i < count; ++i)
        *out[i] = {1, math::Vec3(memory.sum[0][i], memory.sum[1][i], memory.sum[2][i]) * part,
                   2 * memory.behind[i] > samples};
}

} // namespace peregrine::render::bake
