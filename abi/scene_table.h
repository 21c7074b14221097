#pragma once

#include "host_scene.h"

#include <atomic>
#include <cstdint>

namespace peregrine::abi {

inline constexpr uint32_t kMaxScenes = 1024;

// The scenes of the process. Looking one up is two loads from a line that only rt_create_scene and
// rt_destroy_scene write.
struct SceneSlot {
    std::atomic<uint32_t> generation{0}; // 0: free
    uint32_t last_generation = 0;        // the table's mutex guards it
    std::atomic<HostScene*> scene{nullptr};
};
static_assert(sizeof(SceneSlot) == 16);

extern constinit SceneSlot scene_slots[kMaxScenes];

[[noreturn, gnu::cold]] void fail_scene(rt_scene handle);

// Throws base::Error invalid_handle for anything but a living scene.
inline HostScene& find_scene(rt_scene handle) {
    if (handle.index < kMaxScenes && handle.generation != 0) [[likely]] {
        const SceneSlot& slot = scene_slots[handle.index];
        if (slot.generation.load(std::memory_order_acquire) == handle.generation) [[likely]]
            return *slot.scene.load(std::memory_order_relaxed);
    }
    fail_scene(handle);
}

// Takes the scene if there is room; throws base::Error limit if not.
rt_scene insert_scene(HostScene* scene);

// Makes the handle stale and gives the scene back; invalid_handle as above.
HostScene* take_scene(rt_scene handle);

} // namespace peregrine::abi
