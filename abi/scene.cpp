#include "base/isa.h"
#include "check.h"
#include "guard.h"
#include "read_struct.h"
#include "scene_table.h"

namespace peregrine::abi {
namespace {

constexpr uint32_t kMaxWorkers = 256;

void check(const rt_scene_desc& desc) {
    if (!desc.allocator.allocate != !desc.allocator.deallocate)
        base::fail(base::Code::invalid_argument, "rt_scene_desc.allocator.%s is null",
                   desc.allocator.allocate ? "deallocate" : "allocate");
    require_zero(desc.scheduler.reserved, "rt_scene_desc.scheduler.reserved");
    if (desc.scheduler.run && desc.scheduler.concurrency == 0)
        base::fail(base::Code::invalid_argument,
                   "rt_scene_desc.scheduler.concurrency is 0; it must be at least 1");
    if (!desc.scheduler.run && desc.worker_count > kMaxWorkers)
        base::fail(base::Code::limit, "rt_scene_desc.worker_count is %u; the limit is %u",
                   desc.worker_count, kMaxWorkers);
    require_enum(desc.isa, RT_ISA_NEON, "rt_scene_desc.isa");
    require_zero(desc.reserved, "rt_scene_desc.reserved");
    if (!base::is_available(base::Isa(desc.isa)))
        base::fail(base::Code::unsupported,
                   "rt_scene_desc.isa is %d, an instruction set that this machine or build lacks",
                   desc.isa);
}

scene::SceneOptions to_options(const rt_scene_desc& desc) {
    scene::SceneOptions options;
    options.memory = {desc.allocator.user, desc.allocator.allocate, desc.allocator.deallocate};
    options.host_scheduler = {desc.scheduler.user, desc.scheduler.run, desc.scheduler.concurrency};
    options.worker_count = desc.worker_count;
    options.isa = base::Isa(desc.isa);
    return options;
}

void destroy(HostScene* host) {
    // The scene counts its own memory; itself it came from in front of that count.
    base::HostMemory memory(host->memory);
    std::pmr::polymorphic_allocator<>(&memory).delete_object(host);
}

rt_scene create(const rt_scene_desc& desc) {
    const scene::SceneOptions options = to_options(desc);
    base::HostMemory memory(options.memory);
    auto* host = std::pmr::polymorphic_allocator<>(&memory).new_object<HostScene>(options, desc.log,
                                                                                  desc.log_user);
    try {
        return insert_scene(host);
    } catch (...) {
        destroy(host);
        throw;
    }
}

} // namespace
} // namespace peregrine::abi

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_create_scene(const rt_scene_desc* desc, rt_scene* out_scene) noexcept {
    return guard([&] {
        require_pointer(out_scene, "out_scene");
        const rt_scene_desc fields = read_struct(desc);
        check(fields);
        *out_scene = create(fields);
    });
}

rt_result rt_destroy_scene(rt_scene scene) noexcept {
    return guard([&] { destroy(take_scene(scene)); });
}

rt_result rt_set_world_origin(rt_scene scene, const double* origin) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(origin, "origin");
        const double point[3] = {origin[0], origin[1], origin[2]};
        require_position(point, "origin");
        host.scene.set_origin({point[0], point[1], point[2]});
    });
}

rt_result rt_get_scene_stats(rt_scene scene, rt_scene_stats* out_stats) noexcept {
    return guard([&] {
        require_pointer(out_stats, "out_stats");
        scene::Scene& engine = find_scene(scene).scene;
        const Output output(out_stats);
        rt_scene_stats stats = rt_default_scene_stats();
        stats.threads = engine.scheduler.concurrency();
        stats.mesh_count = engine.meshes.count();
        stats.material_count = engine.materials.count();
        stats.texture_count = engine.textures.count();
        stats.light_count = engine.lights.count();
        stats.snapshot_version = engine.version();
        stats.snapshots_alive = engine.snapshots.reclaim();
        stats.isa = rt_isa(engine.isa());
        stats.bytes_allocated = engine.memory.bytes();
        stats.bytes_peak = engine.memory.peak();
        stats.allocation_count = engine.memory.allocations();
        output.write(stats);
    });
}
