#pragma once

#include "render/bake/sample.h"
#include "shade/occlusion/openness.h"
#include "shade/shader.h"
#include "trace/filter.h"

#include <span>

namespace peregrine::render::bake {

// One thread's working memory.
struct alignas(64) SamplerMemory {
    using Lanes = shade::Surface::Lanes;

    shade::Scratch scratch;
    shade::OpennessMemory openness;
    shade::OpenPoints points;
    Lanes origin[3];
    Lanes direction[3];
    Lanes t, u, v; // of places, then of what their rays hit
    uint32_t triangle[shade::kPadded];
    uint32_t back_face[shade::kPadded];
    uint32_t behind[shade::kPadded]; // rays of each point that saw the back of a solid
    Lanes radiance[3];
    Lanes sum[3];
    uint64_t ray_count;
};

// Finds what comes to places from all around. Read-only: all threads share it.
class Sampler {
public:
    // Of a FixedWorld. Both must outlive it.
    Sampler(const scene::Snapshot& fixed, const shade::Shader& shader);
    virtual ~Sampler() = default;

    // At most shade::kBatch places.
    virtual void sample(std::span<const Place> places, SamplerMemory& memory,
                        Sample* const* out) const = 0;

protected:
    // Makes them memory.points, as if each had been hit from its front; returns these hits.
    shade::RayHits place(std::span<const Place> places, SamplerMemory& memory) const;
    // The same ray of all of them. Where the back of a solid is hit, that is counted, and is no
    // hit.
    shade::RayHits trace(const shade::OpenRay& ray, SamplerMemory& memory) const;

    const scene::Snapshot& fixed_;
    const shade::Shader& shader_;

private:
    static shade::RayHits hits_of(const SamplerMemory& memory, uint32_t count, float footprint);

    trace::Filter filter_;
};

// How much of the ambient light arrives.
class OpennessSampler final : public Sampler {
public:
    OpennessSampler(const scene::Snapshot& fixed, const shade::Shader& shader, float range,
                    uint32_t samples);
    void sample(std::span<const Place> places, SamplerMemory& memory,
                Sample* const* out) const override;

private:
    shade::Openness openness_;
    shade::OpenRays probes_; // for what is buried: short rays do not see that
};

// What other surfaces send.
class LightSampler final : public Sampler {
public:
    LightSampler(const scene::Snapshot& fixed, const shade::Shader& shader, uint32_t samples)
        : Sampler(fixed, shader), rays_(samples, false) {}
    void sample(std::span<const Place> places, SamplerMemory& memory,
                Sample* const* out) const override;

private:
    shade::OpenRays rays_;
};

} // namespace peregrine::render::bake
