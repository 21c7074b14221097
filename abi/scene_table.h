#pragma once

#include "host_scene.h"

#include <atomic>
#include <cstdint>

namespace peregrine::abi {

inline constexpr uint32_t kMaxScenes = 1024;

// A scene's handle as one number.
constexpr uint64_t key_of(rt_scene handle) {
    return handle.index | uint64_t(handle.generation) << 32;
}

// The scenes of the process. Looking one up is two loads from a line that only rt_create_scene and
// rt_destroy_scene write.
struct SceneSlot {
    static constexpr uint32_t kFree = 0xffffffffu;

    std::atomic<uint64_t> key{kFree}; // of the handle; of {kFree, last generation} if free
    std::atomic<HostScene*> scene{nullptr};
};
static_assert(sizeof(SceneSlot) == 16);

extern constinit SceneSlot scene_slots[kMaxScenes];

[[noreturn, gnu::cold]] void fail_scene(rt_scene handle);

// Throws base::Error invalid_handle for anything but a living scene.
inline HostScene& find_scene(rt_scene handle) {
    if (handle.index < kMaxScenes) [[likely]] {
        const SceneSlot& slot = scene_slots[handle.index];
        if (slot.key.load(std::memory_order_acquire) == key_of(handle)) [[likely]]
            return *slot.scene.load(std::memory_order_relaxed);
    }
    fail_scene(handle);
}

// Takes the scene if there is room; throws base::Error limit if not.
rt_scene insert_scene(HostScene* scene);

// Makes the handle stale and gives the scene back; invalid_handle as above.
HostScene* take_scene(rt_scene handle);

} // namespace peregrine::abi
