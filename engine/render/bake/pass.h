#pragma once

#include "base/progress.h"
#include "base/scheduler.h"
#include "render/bake/grid.h"
#include "render/bake/sampler.h"

#include <atomic>

namespace peregrine::render::bake {

// Samples all triangles of a FixedWorld: first the vertices that they share, then what their grids
// want.
class Pass {
public:
    struct Fineness {
        float spacing; // metres
        float tolerance;
    };

    Pass(const scene::Snapshot& fixed, const shade::Shader& shader, const Sampler& sampler,
         const Fineness& fineness, base::Scheduler& scheduler, base::Memory* memory);

    // Throws base::Error cancelled.
    void run(const base::Progress& progress);

    const base::Vector<Grid>& grids() const { return grids_; } // by triangle
    uint64_t sampled() const { return sampled_; }
    uint64_t rays() const;

private:
    struct Vertices {
        base::Vector<uint32_t> first; // by mesh; kNone: its triangles share none
        base::Vector<Place> places;   // of a triangle of each; kNone: it has none
        base::Vector<Sample> samples;
    };
    static constexpr uint32_t kNone = ~0u;

    void list_vertices();
    void sample_vertices(uint32_t batch, SamplerMemory& memory);
    void begin_grids();
    void refine(uint32_t chunk, SamplerMemory& memory);
    void sample(std::span<Grid> grids, std::span<const uint8_t> open, uint32_t first,
                SamplerMemory& memory);
    // Calls work(i, memory) for each i < count.
    template <class Work>
    void share(uint32_t count, const base::Progress& progress, Work&& work);

    const scene::Snapshot& fixed_;
    const Sampler& sampler_;
    Fineness fineness_;
    base::Scheduler& scheduler_;
    base::Memory* memory_;
    base::Vector<SamplerMemory> workers_;
    shade::LightRoom light_room_;
    Vertices vertices_;
    base::Vector<Grid> grids_;
    std::atomic<uint64_t> sampled_{0};
};

} // namespace peregrine::render::bake
