#include "scene_table.h"

#include "base/error.h"

#include <mutex>

namespace peregrine::abi {

constinit SceneSlot scene_slots[kMaxScenes];

namespace {

constinit std::mutex table_mutex;

} // namespace

void fail_scene(rt_scene handle) {
    if (handle.generation == 0) base::fail(base::Code::invalid_handle, "the rt_scene is null");
    base::fail(base::Code::invalid_handle,
               "rt_scene {%u, %u} names no scene: it was destroyed or never created", handle.index,
               handle.generation);
}

rt_scene insert_scene(HostScene* scene) {
    const std::lock_guard lock(table_mutex);
    for (uint32_t i = 0; i < kMaxScenes; ++i) {
        SceneSlot& slot = scene_slots[i];
        if (slot.generation.load(std::memory_order_relaxed) != 0) continue;
        if (++slot.last_generation == 0) slot.last_generation = 1;
        slot.scene.store(scene, std::memory_order_relaxed);
        slot.generation.store(slot.last_generation, std::memory_order_release);
        return {i, slot.last_generation};
    }
    base::fail(base::Code::limit, "there are %u scenes already", kMaxScenes);
}

HostScene* take_scene(rt_scene handle) {
    const std::lock_guard lock(table_mutex);
    HostScene& scene = find_scene(handle);
    scene_slots[handle.index].generation.store(0, std::memory_order_release);
    scene_slots[handle.index].scene.store(nullptr, std::memory_order_relaxed);
    return &scene;
}

} // namespace peregrine::abi
