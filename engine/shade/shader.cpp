#include "shade/shader.h"

#include <algorithm>

namespace peregrine::shade {
Shader::Shader(const scene::Snapshot& snapshot, uint32_t features, bool shadows,
               std::span<const PreparedLight> lights, const math::Vec3d& origin, float unseen)
    : snapshot_(&snapshot), kernels_(&shade::kernels(snapshot.isa())),
      space_(snapshot.world, origin, lights.empty() ? 0 : snapshot.lights->largest_radius),
      features_(features), program_(program_for(features)),
      lighting_(snapshot, lights, space_, program_, shadows, unseen),
      programs_(snapshot, features, space_) {}

void Shader::find_surfaces(const RayHits& hits, SurfacePart part, Scratch& scratch) const {
    uint32_t unasked = 0; // textures that this part does not sample
    if (part != SurfacePart::all && part != SurfacePart::geometry) unasked |= scene::kNormalMaps;
    if (part != SurfacePart::all && part != SurfacePart::colors)
        unasked |= scene::kTextures | scene::kEmissive | scene::kOcclusionTextures;
    if (part == SurfacePart::smooth) unasked |= scene::kRoughnessTextures;
    kernels_->find_surfaces[uint32_t(part)](*snapshot_, features_ & ~unasked, space_, hits,
                                            scratch.surface);
}

void Shader::gather_light(const RayHits& hits, Scratch& scratch, BatchMarks* marks) const {
    const bool spares = programs_.spare_light() && !marks;
    if (spares) programs_.turn_away(hits, scratch);
    lighting_.gather(hits, scratch, marks);
    if (spares) programs_.turn_back(scratch);
}

Surroundings Shader::surroundings() const {
    if (bounced_grids_) return Surroundings::bright;
    const bool hides = finds_openness() || (features_ & scene::kOcclusionTextures);
    return hides ? Surroundings::hidden : Surroundings::even;
}

// What textures hide, they hide of what rays found to arrive, and of what other surfaces send.
void Shader::apply_occlusion_textures(uint32_t count, Scratch& scratch) const {
    const float* const texture = scratch.surface.occlusion;
    Illumination& light = scratch.light;
    if (finds_openness() || bounced_grids_)
        for (uint32_t i = 0; i < count; ++i) light.openness[i] *= texture[i];
    else
        std::copy_n(texture, count, light.openness);
    if (!bounced_grids_) return;
    for (auto& channel : light.bounced)
        for (uint32_t i = 0; i < count; ++i) channel[i] *= texture[i];
}

void Shader::find_radiance(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                           const AskedRays* rays) const {
    const bool emissive = features_ & scene::kEmissive;
    const bool has_textures = features_ & scene::kOcclusionTextures;
    if (has_textures) apply_occlusion_textures(hits.count, scratch);
    const Surroundings from = surroundings();
    kernels_->find_radiance[uint32_t(from)][emissive][uint32_t(program_)](
        scratch.surface, scratch.light, hits, snapshot_->environment, radiance);
    if (has_programs()) programs_.run(hits, radiance, scratch, from, rays);
}

void Shader::find_openness(const RayHits& hits, Scratch& scratch, float* openness) const {
    find_surfaces(hits, SurfacePart::smooth, scratch);
    openness_->find(hits, scratch.surface, scratch.shadow, *scratch.openness, openness);
}

// What moves was not there: rays ask for it alone.
void Shader::recall_openness(const RayHits& hits, Scratch& scratch, float* openness) const {
    kernels_->recall_openness(*openness_grids_, hits, openness);
    if (!snapshot_->world.nodes) return;
    find_surfaces(hits, SurfacePart::smooth, scratch);
    openness_->hide_by_moving(hits, scratch.surface, scratch.shadow, *scratch.openness, openness);
}

void Shader::take_surroundings(const RayHits& hits, const float* openness, Scratch& scratch) const {
    Illumination& light = scratch.light;
    if (openness) {
        std::copy_n(openness, hits.count, light.openness);
    } else if (finds_openness()) {
        std::fill_n(light.openness, hits.count, -1.0f);
        if (recalls_openness()) recall_openness(hits, scratch, light.openness);
        const auto is_unknown = [](float value) { return value < 0; };
        if (std::any_of(light.openness, light.openness + hits.count, is_unknown))
            find_openness(hits, scratch, light.openness);
    } else if (bounced_grids_) {
        std::fill_n(light.openness, hits.count, 1.0f);
    }
    if (bounced_grids_) {
        float* const bounced[3] = {light.bounced[0], light.bounced[1], light.bounced[2]};
        kernels_->recall_bounced(*bounced_grids_, hits, bounced);
    }
}

void Shader::shade(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                   const float* openness) const {
    take_surroundings(hits, openness, scratch);
    find_surfaces(hits, SurfacePart::all, scratch);
    gather_light(hits, scratch, nullptr);
    find_radiance(hits, radiance, scratch);
}

} // namespace peregrine::shade
