#include "scene/scene.h"

#include "base/error.h"

namespace peregrine::scene {

Scene::Scene(const SceneOptions& options)
    : memory(options.memory), scheduler(options.worker_count, options.host_scheduler, &memory),
      textures(&memory), materials(&memory), meshes(&memory), lights(&memory), snapshots(&memory),
      kernels_(trace::select_kernels(options.isa)) {
    if (!kernels_)
        base::fail(base::Code::unsupported,
                   "this machine or build lacks the instruction set %u that the scene asks for",
                   unsigned(options.isa));
}

} // namespace peregrine::scene
