#include "embree_peer.h"

#include "embree_scene.h"

#include <string>

namespace peregrine::bench {

bool has_embree() {
    return true;
}

PeerBuild build_with_embree(std::span<const geometry::Triangle> triangles, uint32_t threads) {
    const EmbreeScene scene(triangles, "threads=" + std::to_string(threads), RTC_SCENE_FLAG_NONE);
    return {scene.seconds(), scene.bytes()};
}

} // namespace peregrine::bench
