#include "shade/path/paths.h"

#include "trace/world/stream.h"

#include <algorithm>
#include <limits>

namespace peregrine::shade {

static_assert(kMostPathRays <= trace::kMaxStream);
static_assert(sizeof(PathRays::Lanes) % 64 == 0);

// Rays of one depth whose hits are known.
struct Paths::Batch {
    const RayHits& hits;    // its t counts along the path
    const float* t;         // of the rays themselves
    const float* origin[3]; // null: the eye
    const Media* media;
    const uint32_t* pixel; // null: `first` and on
    uint32_t first;
    uint32_t depth;

    uint32_t pixel_of(uint32_t i) const { return pixel ? pixel[i] : first + i; }
};

Paths::Paths(const scene::Snapshot& snapshot, const Shader& shader, const Fog& fog,
             const Airlight& airlight, const trace::Filter& filter, const PathLimits& limits,
             const Media& eye)
    : snapshot_(&snapshot), shader_(&shader), fog_(fog.any() ? &fog : nullptr),
      airlight_(airlight.any() ? &airlight : nullptr), filter_(filter), limits_(limits), eye_(eye) {
}

void Paths::begin(PathRays* chunks, PathMemory& memory) const {
    memory.waiting = chunks;
    std::fill_n(memory.t_max, kPathRoom, std::numeric_limits<float>::infinity());
    std::fill_n(memory.eye_media, kBatch, eye_);
}

void Paths::split(const RayHits& hits, const Media* media, PathMemory& memory,
                  Scratch& scratch) const {
    shader_->kernels().split_paths[shader_->has_programs()](*snapshot_, shader_->features(),
                                                            shader_->space(), hits, media,
                                                            scratch.surface, memory.split);
}

void Paths::split(const RayHits& hits, PathMemory& memory, Scratch& scratch) const {
    split(hits, memory.eye_media, memory, scratch);
}

// Takes from memory.weight what media swallow; false if none does.
bool Paths::absorb(const RayHits& hits, const float* t, const Media* media,
                   PathMemory& memory) const {
    bool any = false;
    for (uint32_t i = 0; i < hits.count; ++i) {
        const uint32_t medium = media[i].innermost();
        const math::Vec3& absorption = snapshot_->material_set->materials[medium].absorption;
        for (int k = 0; k < 3; ++k) memory.absorption[k][i] = absorption[k];
        any = any || absorption != math::Vec3(0);
    }
    if (any)
        shader_->kernels().absorb(hits.direction, t, hits.count, memory.absorption, memory.weight);
    return any;
}

void Paths::keep(const RayHits& hits, float* const colors[3], uint32_t first, PathMemory& memory,
                 Scratch& scratch) const {
    memory.footprint = hits.footprint;
    if (!memory.split.any && !eye_.any() && !fog_) return;
    for (auto& weight : memory.weight) std::fill_n(weight, hits.count, 1.0f);
    if (eye_.any() && absorb(hits, hits.t, memory.eye_media, memory))
        for (int k = 0; k < 3; ++k)
            for (uint32_t i = 0; i < hits.count; ++i) colors[k][first + i] *= memory.weight[k][i];
    if (fog_ && !eye_.any()) {
        fog_->find_clear(hits, memory.clear);
        float* const radiance[3] = {colors[0] + first, colors[1] + first, colors[2] + first};
        fog_->veil(memory.clear, hits.count, radiance);
        if (airlight_) airlight_->add(hits, radiance, scratch);
        dim(hits.count, memory);
    }
    send_on({hits, hits.t, {}, memory.eye_media, nullptr, first, 0}, colors, memory);
}

// There is no fog in solids.
void Paths::hide_in_fog(const Batch& batch, float* const radiance[3], PathMemory& memory,
                        Scratch& scratch) const {
    const RayHits& hits = batch.hits;
    fog_->find_clear(batch.origin[1], hits.direction, batch.t, hits.count, memory.clear);
    for (uint32_t i = 0; i < hits.count; ++i)
        if (batch.media[i].any()) memory.clear[i] = 1;
    fog_->veil(memory.clear, hits.count, radiance);
    if (!airlight_) return;
    float* const t = scratch.airlight->t;
    for (uint32_t i = 0; i < hits.count; ++i) t[i] = batch.media[i].any() ? 0 : batch.t[i];
    airlight_->add({{batch.origin[0], batch.origin[1], batch.origin[2]},
                    {hits.direction[0], hits.direction[1], hits.direction[2]},
                    t,
                    hits.count},
                   radiance, scratch);
}

// What comes from behind fog counts for less.
void Paths::dim(uint32_t count, PathMemory& memory) const {
    for (auto& weight : memory.weight)
        for (uint32_t i = 0; i < count; ++i) weight[i] *= memory.clear[i];
}

void Paths::send_on(const Batch& batch, float* const colors[3], PathMemory& memory) const {
    if (!memory.split.any) return;
    PathRays* const to =
        batch.depth < limits_.max_depth ? &memory.waiting[2 * batch.depth] : nullptr;
    send_on(batch, memory.split.mirrored, to, colors, memory);
    send_on(batch, memory.split.through, to ? to + 1 : nullptr, colors, memory);
}

// What is not worth a ray brings the ambient light. `to` null: nothing is.
void Paths::send_on(const Batch& batch, const SplitRays::Branch& branch, PathRays* to,
                    float* const colors[3], PathMemory& memory) const {
    const math::Vec3& ambient = snapshot_->environment.ambient;
    for (uint32_t i = 0; i < batch.hits.count; ++i) {
        float weight[3];
        for (int k = 0; k < 3; ++k) weight[k] = branch.weight[k][i] * memory.weight[k][i];
        const float most = std::max({weight[0], weight[1], weight[2]});
        if (!(most > 0)) continue;
        const uint32_t pixel = batch.pixel_of(i);
        if (!to || most < limits_.least_weight) {
            for (int k = 0; k < 3; ++k) colors[k][pixel] += weight[k] * ambient[k];
            continue;
        }
        const uint32_t ray = to->count++;
        for (int k = 0; k < 3; ++k) {
            to->origin[k][ray] = branch.origin[k][i];
            to->direction[k][ray] = branch.direction[k][i];
            to->weight[k][ray] = weight[k];
        }
        to->travelled[ray] = batch.hits.t[i];
        to->pixel[ray] = pixel;
        to->media[ray] = branch.media[i];
    }
}

void Paths::follow(uint32_t depth, float* const colors[3], PathMemory& memory,
                   Scratch& scratch) const {
    for (uint32_t kind = 0; kind < 2; ++kind) {
        PathRays& rays = memory.waiting[2 * (depth - 1) + kind];
        if (rays.count == 0) continue;
        trace(rays, memory);
        for (uint32_t first = 0; first < rays.count; first += kBatch) {
            const RayHits hits = {
                {rays.direction[0] + first, rays.direction[1] + first, rays.direction[2] + first},
                memory.u + first,
                memory.v + first,
                memory.triangle + first,
                memory.back_face + first,
                memory.along + first,
                std::min(rays.count - first, kBatch),
                memory.footprint};
            for (int k = 0; k < 3; ++k)
                std::copy_n(rays.weight[k] + first, hits.count, memory.weight[k]);
            shade({hits,
                   memory.t + first,
                   {rays.origin[0] + first, rays.origin[1] + first, rays.origin[2] + first},
                   rays.media + first,
                   rays.pixel + first,
                   0,
                   depth},
                  colors, memory, scratch);
        }
        rays.count = 0;
        if (depth < limits_.max_depth) follow(depth + 1, colors, memory, scratch);
    }
}

void Paths::trace(PathRays& rays, PathMemory& memory) const {
    const uint32_t padded = (rays.count + 15) / 16 * 16;
    for (int k = 0; k < 3; ++k) {
        std::fill(rays.origin[k] + rays.count, rays.origin[k] + padded, rays.origin[k][0]);
        std::fill(rays.direction[k] + rays.count, rays.direction[k] + padded, rays.direction[k][0]);
    }
    const SurfaceSpace& space = shader_->space();
    const float* origin[3] = {rays.origin[0], rays.origin[1], rays.origin[2]};
    if (space.is_elsewhere)
        for (int k = 0; k < 3; ++k) {
            for (uint32_t i = 0; i < padded; ++i)
                memory.world_origin[k][i] = float(double(rays.origin[k][i]) + space.origin[k]);
            origin[k] = memory.world_origin[k];
        }
    const trace::RayStream stream = {{origin[0], origin[1], origin[2]},
                                     {rays.direction[0], rays.direction[1], rays.direction[2]},
                                     memory.t_min,
                                     memory.t_max,
                                     rays.count,
                                     trace::Coherence::coherent};
    const trace::Positions positions = {{rays.origin[0], rays.origin[1], rays.origin[2]},
                                        space.origin};
    trace::closest(snapshot_->world, stream, positions, filter_,
                   {memory.t, memory.u, memory.v, memory.triangle, memory.back_face, nullptr});
    for (uint32_t i = 0; i < rays.count; ++i) memory.along[i] = rays.travelled[i] + memory.t[i];
    memory.ray_count += rays.count;
}

void Paths::shade(const Batch& batch, float* const colors[3], PathMemory& memory,
                  Scratch& scratch) const {
    absorb(batch.hits, batch.t, batch.media, memory);
    shader_->take_surroundings(batch.hits, nullptr, scratch);
    shader_->find_surfaces(batch.hits, SurfacePart::all, scratch);
    split(batch.hits, batch.media, memory, scratch);
    shader_->gather_light(batch.hits, scratch, nullptr);
    float* const radiance[3] = {memory.radiance[0], memory.radiance[1], memory.radiance[2]};
    const AskedRays asked{memory.split, batch.media};
    shader_->find_radiance(batch.hits, radiance, scratch, &asked);
    if (shader_->has_sky()) shader_->paint_sky(batch.hits, radiance);
    if (fog_) hide_in_fog(batch, radiance, memory, scratch);
    for (uint32_t i = 0; i < batch.hits.count; ++i)
        for (int k = 0; k < 3; ++k)
            colors[k][batch.pixel[i]] += memory.weight[k][i] * radiance[k][i];
    if (fog_) dim(batch.hits.count, memory);
    send_on(batch, colors, memory);
}

} // namespace peregrine::shade
