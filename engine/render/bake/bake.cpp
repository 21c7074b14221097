#include "render/bake/bake.h"

#include "base/error.h"
#include "render/bake/fixed_world.h"
#include "render/bake/pass.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace peregrine::render::bake {
namespace {

using scene::LightMap;
using scene::PointGrids;

// Light between surfaces changes more slowly than what is in its way.
constexpr float kLightSpacing = 4, kLightTolerance = 5; // of openness

constexpr uint64_t kLeastBytes = sizeof(uint32_t) * (1 + PointGrids::count(0)); // a triangle

uint32_t openness_of(const Sample& sample) {
    return uint32_t(std::lround(sample.open * 65535.0f));
}
uint32_t light_of(const Sample& sample) {
    return scene::SharedExponent::encode(sample.light);
}

uint64_t bytes(const base::Vector<Grid>& grids, uint32_t most_level) {
    uint64_t points = 0;
    for (const Grid& grid : grids) points += PointGrids::count(std::min(grid.level(), most_level));
    if (points > PointGrids::kMostPoints) return ~uint64_t(0);
    return (grids.size() + points) * sizeof(uint32_t);
}

// As fine as memory allows.
uint32_t most_level(const base::Vector<Grid>& grids, uint64_t most_bytes) {
    uint32_t level = PointGrids::kMaxLevel;
    while (level > 0 && bytes(grids, level) > most_bytes) --level;
    const uint64_t needed = bytes(grids, level);
    if (needed > most_bytes)
        base::fail(base::Code::limit,
                   "what is baked of these static meshes takes at least %llu bytes; at most %llu "
                   "are allowed",
                   static_cast<unsigned long long>(needed),
                   static_cast<unsigned long long>(most_bytes));
    return level;
}

void write(const base::Vector<Grid>& grids, uint64_t most_bytes,
           uint32_t (*encode)(const Sample& sample), PointGrids& out) {
    const uint32_t most = most_level(grids, most_bytes);
    out.grids.reserve(grids.size());
    out.values.reserve(bytes(grids, most) / sizeof(uint32_t) - grids.size());
    for (const Grid& grid : grids) {
        const uint32_t level = std::min(grid.level(), most), side = 1u << level;
        const uint32_t skip = grid.level() - level;
        out.grids.push_back(PointGrids::bits(level, uint32_t(out.values.size())));
        for (uint32_t iv = 0; iv <= side; ++iv)
            for (uint32_t iu = 0; iu + iv <= side; ++iu)
                out.values.push_back(encode(
                    grid.samples()[PointGrids::index(grid.level(), iu << skip, iv << skip)]));
    }
}

class Baker {
public:
    Baker(const scene::Snapshot& snapshot, const Options& options, base::Scheduler& scheduler,
          base::Memory* memory, Report& report)
        : world_(snapshot, memory), options_(options), scheduler_(scheduler), memory_(memory),
          report_(report), left_bytes_(options.most_bytes),
          steps_(options.bounces + (options.range > 0 ? 1 : 0)),
          map_(std::allocate_shared<LightMap>(std::pmr::polymorphic_allocator<LightMap>(memory),
                                              memory)) {
        map_->geometry = world_.snapshot.fixed;
        map_->range = options.range;
        const uint64_t least = world_.snapshot.fixed->infos.size() * kLeastBytes;
        if (options.range > 0 && options.bounces > 0) reserved_bytes_ = least;
    }

    std::shared_ptr<const LightMap> run() {
        if (options_.range > 0) bake_openness();
        for (uint32_t i = 0; i < options_.bounces; ++i) bake_light();
        report_.points = map_->openness.values.size() + map_->bounced.values.size();
        report_.bytes = map_->bytes();
        return map_;
    }

private:
    shade::Shader make_shader(bool lit) const {
        const scene::Snapshot& fixed = world_.snapshot;
        std::span<const scene::PreparedLight> lights;
        if (lit) lights = fixed.lights->prepared;
        return {fixed, fixed.features, true, lights, math::Vec3d(0), 0};
    }

    void bake_openness() {
        const shade::Shader shader = make_shader(false);
        const OpennessSampler sampler(world_.snapshot, shader, options_.range, options_.samples);
        run(shader, sampler, {options_.spacing, options_.tolerance}, openness_of, map_->openness);
        left_bytes_ -= map_->openness.bytes();
        reserved_bytes_ = 0;
    }

    // Surfaces send on what came to them in the bounce before.
    void bake_light() {
        const PointGrids last = std::exchange(map_->bounced, PointGrids(memory_));
        shade::Shader shader = make_shader(true);
        if (last.any()) shader.add_bounced_light_from(last);
        const LightSampler sampler(world_.snapshot, shader, options_.samples);
        run(shader, sampler,
            {options_.spacing * kLightSpacing, options_.tolerance * kLightTolerance}, light_of,
            map_->bounced);
    }

    void run(const shade::Shader& shader, const Sampler& sampler, const Pass::Fineness& fineness,
             uint32_t (*encode)(const Sample& sample), PointGrids& out) {
        Pass pass(world_.snapshot, shader, sampler, fineness, scheduler_, memory_);
        const float share = 1.0f / float(steps_);
        base::PartProgress part(options_.progress, float(step_++) * share, share);
        pass.run(part.progress());
        write(pass.grids(), left_bytes_ - std::min(left_bytes_, reserved_bytes_), encode, out);
        report_.sampled += pass.sampled();
        report_.rays += pass.rays();
    }

    const FixedWorld world_;
    const Options& options_;
    base::Scheduler& scheduler_;
    base::Memory* memory_;
    Report& report_;
    uint64_t left_bytes_, reserved_bytes_ = 0;
    uint32_t steps_, step_ = 0;
    std::shared_ptr<LightMap> map_;
};

} // namespace

std::shared_ptr<const LightMap> bake(const scene::Snapshot& snapshot, const Options& options,
                                     base::Scheduler& scheduler, base::Memory* memory,
                                     Report& report) {
    const auto begin = std::chrono::steady_clock::now();
    report = {};
    std::shared_ptr<const LightMap> map;
    if (!snapshot.fixed->infos.empty())
        map = Baker(snapshot, options, scheduler, memory, report).run();
    report.ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return map;
}

} // namespace peregrine::render::bake
