#pragma once

#include "peregrine/rt.h"
#include "scene/scene.h"

#include <cstdarg>

namespace peregrine::abi {

// What a scene handle stands for: the engine's scene and the host's ear.
struct HostScene {
    HostScene(const scene::SceneOptions& options, rt_log_function log_function, void* user)
        : memory(options.memory), log(log_function), log_user(user), scene(options) {}

    base::HostMemory::Functions memory; // this object itself came from there
    rt_log_function log;
    void* log_user;
    scene::Scene scene;
};

// Tells the host, if it listens. Nothing that its function throws comes back.
[[gnu::format(printf, 3, 4)]] void log_line(const HostScene& host, rt_log_level level,
                                            const char* format, ...) noexcept;

} // namespace peregrine::abi
