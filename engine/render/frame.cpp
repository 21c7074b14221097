#include "render/frame.h"

#include "render/bounces.h"
#include "render/film.h"
#include "render/particles.h"
#include "render/plan.h"
#include "render/post/bloom.h"
#include "render/post/edge_rays.h"
#include "render/post/edges.h"
#include "render/post/enlarge.h"
#include "render/post/luminance.h"
#include "render/primary_rays.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>

namespace peregrine::render {
namespace {

uint32_t tiles_of(const Extent& extent) {
    return Tile::tile_count(extent.width, extent.height);
}

// Everything that a frame's passes work with. Making it allocates all that they need.
class FrameRun {
public:
    FrameRun(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
             base::Scheduler& scheduler, base::Memory* memory)
        : scheduler_(scheduler), moved_lights_(memory), film_(make_film(frame, memory)),
          bloom_(make_bloom(frame, memory)), particles_(make_particles(frame, memory)),
          plan_(snapshot, camera, frame, moved_lights_, film_ ? &*film_ : nullptr,
                bloom_ ? &*bloom_ : nullptr, particles_ ? &*particles_ : nullptr),
          workers_(std::min(scheduler.concurrency(), tiles_of(plan_.extent)), memory),
          tile_lights_(frame.keeps_light() ? workers_.size() : 0, memory),
          tile_openness_(plan_.shader.finds_openness() ? workers_.size() : 0, memory),
          program_memory_(plan_.shader.has_programs() ? workers_.size() : 0, memory),
          airlight_(plan_.airlight.any() ? workers_.size() : 0, memory),
          tints_(plan_.shader.tints_light() ? workers_.size() : 0, memory),
          luminance_(frame.counts_luminance() ? workers_.size() : 0, memory),
          light_room_(plan_.shader.light_choice().make_room(uint32_t(workers_.size()), memory)),
          path_room_(plan_, workers_.size(), memory),
          edges_(frame.looks_for_edges() ? workers_.size() : 0, memory) {}

    void run() {
        for_each_worker([&](uint32_t i) {
            workers_[i].scratch.shadow.initialize();
            workers_[i].scratch.lists = light_room_.lists(i);
            if (!tile_lights_.empty()) workers_[i].light = &tile_lights_[i];
            workers_[i].paths = path_room_.memory(plan_, i);
            if (!tile_openness_.empty()) {
                workers_[i].openness = &tile_openness_[i];
                workers_[i].scratch.openness = &tile_openness_[i].memory;
            }
            if (!program_memory_.empty()) workers_[i].scratch.programs = &program_memory_[i];
            if (!airlight_.empty()) {
                workers_[i].scratch.airlight = &airlight_[i];
                plan_.airlight.begin(plan_.eye, airlight_[i]);
            }
            if (!tints_.empty()) workers_[i].scratch.tints = &tints_[i];
            if (!luminance_.empty()) workers_[i].luminance = &luminance_[i];
            begin_primary_rays(plan_, workers_[i]);
        });
        if (particles_)
            share(particles_->share_count(), [&](uint32_t i, uint32_t worker) {
                particles_->find(plan_, i, workers_[worker]);
            });
        run(plan_.stages());
        if (bloom_) {
            spread_light();
            run(plan_.later_stages());
        }
        if (plan_.frame.looks_for_edges()) sharpen_edges();
        if (plan_.frame.is_enlarged()) enlarge();
    }

    void add_to(FrameStats& stats) {
        for (size_t i = 1; i < luminance_.size(); ++i) luminance_[0].add(luminance_[i]);
        if (!luminance_.empty()) stats.mean_luminance = luminance_[0].mean();
        stats.rays_primary += uint64_t(plan_.extent.width) * plan_.extent.height;
        for (const TileBuffers& buffers : workers_) {
            stats.rays_shadow += buffers.scratch.shadow.ray_count;
            stats.light_points += buffers.light_point_count;
            stats.rays_edge += buffers.edge_ray_count;
            stats.rays_particle += buffers.particle_ray_count;
        }
        stats.rays_bounced += path_room_.ray_count();
        for (const shade::TileOpenness& openness : tile_openness_) {
            stats.rays_occlusion += openness.memory.ray_count;
            stats.occlusion_points += openness.point_count;
        }
        for (const shade::ProgramMemory& programs : program_memory_) {
            stats.program_hits += programs.hit_count;
            stats.program_faults += programs.fault_count;
        }
    }

private:
    static std::optional<Film> make_film(const Frame& frame, base::Memory* memory) {
        if (!Film::is_needed(frame)) return std::nullopt;
        return std::optional<Film>(std::in_place, frame, memory);
    }
    static std::optional<post::Bloom> make_bloom(const Frame& frame, base::Memory* memory) {
        if (!frame.blooms()) return std::nullopt;
        return std::optional<post::Bloom>(std::in_place, frame, memory);
    }

    static std::optional<Particles> make_particles(const Frame& frame, base::Memory* memory) {
        if (!frame.shows_particles()) return std::nullopt;
        return std::optional<Particles>(std::in_place, frame, memory);
    }

    template <class Work>
    void for_each_worker(Work&& work) {
        scheduler_.for_each(uint32_t(workers_.size()), work);
    }

    // Calls work(i, worker) for each i < count.
    template <class Work>
    void share(uint32_t count, Work&& work) {
        if (count == 1) return work(0, 0);
        std::atomic<uint32_t> next{0};
        for_each_worker([&](uint32_t worker) {
            for (uint32_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;)
                work(i, worker);
        });
    }

    template <class Work>
    void for_each_tile(Work&& work) {
        share(tiles_of(plan_.extent), [&](uint32_t tile, uint32_t worker) {
            workers_[worker].tile.place(tile, plan_.extent.width, plan_.extent.height);
            work(workers_[worker], worker);
        });
    }

    void run(std::span<const Stage> stages) {
        for_each_tile([&](TileBuffers& buffers, uint32_t) {
            for (const Stage stage : stages) stage(plan_, buffers);
        });
    }

    // Calls work(row) for each row of a level of the bloom.
    template <class Work>
    void for_each_row(uint32_t level, Work&& work) {
        constexpr uint32_t kRows = 8; // at a time
        const uint32_t height = bloom_->height(level);
        share((height + kRows - 1) / kRows, [&](uint32_t i, uint32_t) {
            const uint32_t end = std::min((i + 1) * kRows, height);
            for (uint32_t y = i * kRows; y < end; ++y) work(y);
        });
    }

    void spread_light() {
        const post::Kernels& kernels = post::kernels(plan_.snapshot.isa());
        for (uint32_t level = 0; level < bloom_->level_count(); ++level)
            for_each_row(level, [&](uint32_t y) { bloom_->halve(kernels, *film_, level, y); });
        for (uint32_t level = bloom_->level_count() - 1; level-- > 0;)
            for_each_row(level, [&](uint32_t y) { bloom_->gather(kernels, level, y); });
    }

    void sharpen_edges() {
        const Approximations& options = plan_.frame.approximations;
        for_each_tile([&](TileBuffers& buffers, uint32_t worker) {
            post::find_tile_edges(plan_, buffers.tile, edges_[worker]);
        });
        const post::EdgePattern pattern(options.edge_samples);
        const auto pixels = double(plan_.extent.width) * plan_.extent.height;
        const double most = options.edge_budget > 0
                                ? std::floor(double(options.edge_budget) * pixels / pattern.count)
                                : pixels;
        const uint32_t least = post::least_key(edges_, uint64_t(std::min(most, pixels)));
        for_each_tile([&](TileBuffers& buffers, uint32_t) {
            post::trace_tile_edges(plan_, pattern, least, buffers);
        });
    }

    void enlarge() {
        share(post::enlarged_block_count(plan_.frame),
              [&](uint32_t block, uint32_t) { post::enlarge_block(plan_, block); });
    }

    base::Scheduler& scheduler_;
    base::Vector<shade::PreparedLight> moved_lights_;
    std::optional<Film> film_;
    std::optional<post::Bloom> bloom_;
    std::optional<Particles> particles_;
    const Plan plan_;
    base::Vector<TileBuffers> workers_;
    base::Vector<shade::TileLight> tile_lights_;        // of each worker
    base::Vector<shade::TileOpenness> tile_openness_;   // of each worker
    base::Vector<shade::ProgramMemory> program_memory_; // of each worker
    base::Vector<shade::AirlightMemory> airlight_;      // of each worker
    base::Vector<shade::TintMemory> tints_;             // ... if light is tinted
    base::Vector<post::LuminanceCounts> luminance_;     // of each worker
    shade::LightRoom light_room_;
    PathRoom path_room_;
    base::Vector<post::EdgeCounts> edges_; // of each worker
};

} // namespace

void render_frame(const scene::Snapshot& snapshot, const Camera& camera, const Frame& frame,
                  base::Scheduler& scheduler, base::Memory* memory, FrameStats* stats) {
    const auto begin = std::chrono::steady_clock::now();
    // Planes are never enlarged: beside a picture that is, they are a frame of their own.
    Frame picture = frame, planes = frame;
    std::optional<FrameRun> planes_run;
    if (frame.is_enlarged() && frame.wants_planes()) {
        picture.depth = picture.triangle_ids = picture.mesh_ids = picture.normals = {};
        planes.pixels = nullptr;
        planes_run.emplace(snapshot, camera, planes, scheduler, memory);
    }
    FrameRun picture_run(snapshot, camera, picture, scheduler, memory);
    if (planes_run) planes_run->run();
    picture_run.run();

    if (!stats) return;
    *stats = {};
    stats->threads = scheduler.concurrency();
    if (planes_run) planes_run->add_to(*stats);
    picture_run.add_to(*stats);
    stats->isa = snapshot.isa();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    stats->frame_ms = elapsed.count();
}

} // namespace peregrine::render
