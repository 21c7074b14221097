#include "render/bake/pass.h"

#include "base/error.h"

#include <algorithm>

namespace peregrine::render::bake {
namespace {

constexpr uint32_t kChunk = 64; // triangles that are refined together
constexpr uint32_t kRound = 8;  // tasks of a thread between two looks at the progress

struct Corners {
    const std::array<uint32_t, 3>& vertices;
    math::Vec3 v[3];

    float longest() const {
        return std::max(
            {glm::length(v[1] - v[0]), glm::length(v[2] - v[1]), glm::length(v[0] - v[2])});
    }
};

Corners corners_of(const scene::Snapshot& snapshot, uint32_t triangle) {
    const geometry::TriangleInfo info = snapshot.fixed->infos[triangle];
    const scene::MeshData& mesh = *snapshot.meshes[info.mesh].data;
    const auto& vertices = mesh.triangles()[info.primitive];
    return {
        vertices,
        {mesh.positions[vertices[0]], mesh.positions[vertices[1]], mesh.positions[vertices[2]]}};
}

// A point at a triangle's edge may lie in the plane of a wall that stands there.
Place inside(uint32_t triangle, float u, float v, float longest) {
    constexpr float kInset = 0.02f, kMostPart = 0.1f, kThird = 1.0f / 3;
    const float part = std::min(kMostPart, kInset / longest);
    return {triangle, u + (kThird - u) * part, v + (kThird - v) * part};
}

} // namespace

Pass::Pass(const scene::Snapshot& fixed, const shade::Shader& shader, const Sampler& sampler,
           const Fineness& fineness, base::Scheduler& scheduler, base::Memory* memory)
    : fixed_(fixed), sampler_(sampler), fineness_(fineness), scheduler_(scheduler), memory_(memory),
      workers_(std::max(scheduler.concurrency(), 1u), memory),
      light_room_(shader.light_choice().make_room(uint32_t(workers_.size()), memory)),
      vertices_{base::Vector<uint32_t>(memory), base::Vector<Place>(memory),
                base::Vector<Sample>(memory)},
      grids_(memory) {
    for (uint32_t i = 0; i < workers_.size(); ++i) {
        workers_[i].scratch.shadow.initialize();
        workers_[i].scratch.lists = light_room_.lists(i);
    }
}

uint64_t Pass::rays() const {
    uint64_t rays = 0;
    for (const SamplerMemory& worker : workers_)
        rays += worker.ray_count + worker.openness.ray_count + worker.scratch.shadow.ray_count;
    return rays;
}

template <class Work>
void Pass::share(uint32_t count, const base::Progress& progress, Work&& work) {
    const auto round = uint32_t(workers_.size()) * kRound;
    for (uint32_t begin = 0; begin < count; begin += round) {
        if (progress.cancels(float(begin) / float(count)))
            base::fail(base::Code::cancelled, "baking was cancelled by its progress callback");
        std::atomic<uint32_t> next{begin};
        const uint32_t end = std::min(begin + round, count);
        scheduler_.for_each(uint32_t(workers_.size()), [&](uint32_t worker) {
            for (uint32_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < end;)
                work(i, workers_[worker]);
        });
    }
}

// Vertices with normals are the same place to all triangles that they are corners of.
void Pass::list_vertices() {
    vertices_.first.resize(fixed_.meshes.size(), kNone);
    uint32_t count = 0;
    for (uint32_t i = 0; i < fixed_.fixed->infos.size(); ++i) {
        const uint32_t slot = fixed_.fixed->infos[i].mesh;
        const scene::MeshData& mesh = *fixed_.meshes[slot].data;
        if (mesh.normals.empty()) continue;
        if (vertices_.first[slot] == kNone) {
            vertices_.first[slot] = count;
            count += uint32_t(mesh.positions.size());
            vertices_.places.resize(count, Place{kNone, 0, 0});
        }
        const Corners corners = corners_of(fixed_, i);
        const float longest = corners.longest();
        for (uint32_t k = 0; k < 3; ++k) {
            Place& place = vertices_.places[vertices_.first[slot] + corners.vertices[k]];
            if (place.triangle == kNone)
                place = inside(i, k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f, longest);
        }
    }
    vertices_.samples.resize(count);
}

void Pass::sample_vertices(uint32_t batch, SamplerMemory& memory) {
    Place places[shade::kBatch];
    Sample* out[shade::kBatch];
    uint32_t wanted = 0;
    const auto count = uint32_t(vertices_.places.size());
    const uint32_t end = std::min((batch + 1) * shade::kBatch, count);
    for (uint32_t vertex = batch * shade::kBatch; vertex < end; ++vertex) {
        if (vertices_.places[vertex].triangle == kNone) continue;
        places[wanted] = vertices_.places[vertex];
        out[wanted++] = &vertices_.samples[vertex];
    }
    if (wanted > 0) sampler_.sample({places, wanted}, memory, out);
    sampled_.fetch_add(wanted, std::memory_order_relaxed);
}

void Pass::begin_grids() {
    const auto count = uint32_t(fixed_.fixed->infos.size());
    grids_.reserve(count);
    for (uint32_t i = 0; i < count; ++i) {
        const Corners corners = corners_of(fixed_, i);
        Grid& grid = grids_.emplace_back(corners.longest(), fineness_.spacing, memory_);
        const uint32_t first = vertices_.first[fixed_.fixed->infos[i].mesh];
        if (first == kNone) continue;
        for (uint32_t k = 0; k < 3; ++k)
            grid.set_corner(k, vertices_.samples[first + corners.vertices[k]]);
    }
}

void Pass::sample(std::span<Grid> grids, std::span<const uint8_t> open, uint32_t first,
                  SamplerMemory& memory) {
    Place places[shade::kBatch];
    Sample* out[shade::kBatch];
    uint32_t count = 0;
    const auto flush = [&] {
        if (count > 0) sampler_.sample({places, count}, memory, out);
        sampled_.fetch_add(count, std::memory_order_relaxed);
        count = 0;
    };
    for (uint32_t i = 0; i < grids.size(); ++i) {
        if (!open[i]) continue;
        const float longest = corners_of(fixed_, first + i).longest();
        grids[i].for_each_wanted([&](float u, float v, Sample& sample) {
            places[count] = inside(first + i, u, v, longest);
            out[count++] = &sample;
            if (count == shade::kBatch) flush();
        });
    }
    flush();
}

void Pass::refine(uint32_t chunk, SamplerMemory& memory) {
    const uint32_t first = chunk * kChunk;
    const auto count = std::min(kChunk, uint32_t(grids_.size()) - first);
    const std::span<Grid> grids = std::span(grids_).subspan(first, count);
    uint8_t open[kChunk];
    std::fill_n(open, count, uint8_t(1));
    for (bool any = true; any;) {
        sample(grids, {open, count}, first, memory);
        any = false;
        for (uint32_t i = 0; i < count; ++i) {
            if (!open[i]) continue;
            open[i] = grids[i].refine(fineness_.tolerance);
            any = any || open[i];
        }
    }
    for (Grid& grid : grids) grid.dig_out();
}

void Pass::run(const base::Progress& progress) {
    list_vertices();
    const auto count = uint32_t(vertices_.places.size());
    const uint32_t batches = (count + shade::kBatch - 1) / shade::kBatch;
    const uint32_t chunks = (uint32_t(fixed_.fixed->infos.size()) + kChunk - 1) / kChunk;
    const float part = float(batches) / float(batches + chunks);
    share(batches, base::PartProgress(progress, 0, part).progress(),
          [&](uint32_t batch, SamplerMemory& memory) { sample_vertices(batch, memory); });
    begin_grids();
    share(chunks, base::PartProgress(progress, part, 1 - part).progress(),
          [&](uint32_t chunk, SamplerMemory& memory) { refine(chunk, memory); });
}

} // namespace peregrine::render::bake
