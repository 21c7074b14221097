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
        const uint64_t key = slot.key.load(std::memory_order_relaxed);
        if (uint32_t(key) != SceneSlot::kFree) continue;
        const auto last_generation = uint32_t(key >> 32);
        const rt_scene handle = {i, last_generation + 1 ? last_generation + 1 : 1};
        slot.scene.store(scene, std::memory_order_relaxed);
        slot.key.store(key_of(handle), std::memory_order_release);
        return handle;
    }
    base::fail(base::Code::limit, "there are %u scenes already", kMaxScenes);
}

HostScene* take_scene(rt_scene handle) {
    const std::lock_guard lock(table_mutex);
    HostScene& scene = find_scene(handle);
    scene_slots[handle.index].key.store(key_of({SceneSlot::kFree, handle.generation}),
                                        std::memory_order_release);
    scene_slots[handle.index].scene.store(nullptr, std::memory_order_relaxed);
    return &scene;
}

} // namespace peregrine::abi
