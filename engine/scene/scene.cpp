#include "scene/scene.h"

#include "base/error.h"
#include "scene/commit.h"
#include "scene/draft.h"

#include <atomic>
#include <chrono>

namespace peregrine::scene {
namespace {

// A different one for each of the next 2^31 scenes, far from those of its neighbours.
uint32_t next_first_generation() {
    static std::atomic<uint32_t> scenes{0};
    return scenes.fetch_add(1, std::memory_order_relaxed) * 0x9e3779b2u | 1;
}

} // namespace

Scene::Scene(const SceneOptions& options)
    : first_generation_(next_first_generation()), memory(options.memory), recycled(&memory),
      frame_memory(&memory), scheduler(options.worker_count, options.host_scheduler, &memory),
      textures(first_generation_, &memory), programs(first_generation_, &memory),
      materials(first_generation_, &memory), meshes(first_generation_, &memory),
      lights(first_generation_, &memory), snapshots(first_generation_, &recycled),
      isa_(options.isa == base::Isa::best ? base::best_isa() : options.isa), views_(&recycled),
      extents_(&memory), places_(&memory) {
    if (!base::is_available(isa_))
        base::fail(base::Code::unsupported,
                   "this machine or build lacks the instruction set %u that the scene asks for",
                   unsigned(options.isa));
}

CommitReport Scene::commit(const CommitOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    snapshots.reserve();
    Draft draft(snapshots);
    Commit commit(*this, options, *draft);
    commit.prepare();
    CommitReport report = commit.report();
    commit.remember();
    draft.publish();
    recycled.trim();
    frame_memory.trim_unused();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    report.commit_ms = elapsed.count();
    return report;
}

void Scene::set_origin(const math::Vec3d& origin) {
    origin_ = origin;
    for (auto& slot : meshes.slots())
        if (slot.object && slot.object->kind == MeshKind::rigid)
            slot.object->stand(slot.object->transform, origin_);
}

void Scene::set_light_map(std::shared_ptr<const LightMap> map) {
    const std::lock_guard lock(light_map_mutex_);
    light_map_.swap(map);
}

void Scene::touch_flags() {
    touch_triangles(MeshKind::fixed);
    ++flags_version_;
}

} // namespace peregrine::scene
