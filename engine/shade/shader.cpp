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

// What textures hide, they hide of what rays found to arrive.
void Shader::apply_occlusion_textures(uint32_t count, Scratch& scratch) const {
    const float* const texture = scratch.surface.occlusion;
    float* const openness = scratch.light.openness;
    if (finds_openness())
        for (uint32_t i = 0; i < count; ++i) openness[i] *= texture[i];
    else
        std::copy_n(texture, count, openness);
}

void Shader::find_radiance(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                           const AskedRays* rays) const {
    const bool emissive = features_ & scene::kEmissive;
    const bool has_textures = features_ & scene::kOcclusionTextures;
    if (has_textures) apply_occlusion_textures(hits.count, scratch);
    const bool opens = finds_openness() || has_textures;
    kernels_->find_radiance[opens][emissive][uint32_t(program_)](
        scratch.surface, scratch.light, hits, snapshot_->environment, radiance);
    if (has_programs()) programs_.run(hits, radiance, scratch, opens, rays);
}

void Shader::take_openness(const RayHits& hits, const float* openness, Scratch& scratch) const {
    if (!finds_openness()) return;
    if (openness) {
        std::copy_n(openness, hits.count, scratch.light.openness);
    } else {
        find_surfaces(hits, SurfacePart::smooth, scratch);
        find_openness(hits, scratch, scratch.light.openness);
    }
}

void Shader::shade(const RayHits& hits, float* const radiance[3], Scratch& scratch,
                   const float* openness) const {
    take_openness(hits, openness, scratch);
    find_surfaces(hits, SurfacePart::all, scratch);
    gather_light(hits, scratch, nullptr);
    find_radiance(hits, radiance, scratch);
}

} // namespace peregrine::shade
