#include "embree_peer.h"

#include "embree_scene.h"

#include <string>

namespace peregrine::bench {

bool has_embree() {
    return true;
}

PeerBuild build_with_embree(std::span<const geometry::Triangle> triangles, uint32_t threads,
                            const std::string& quality) {
    const RTCBuildQuality rtc_quality = quality == "low"      ? RTC_BUILD_QUALITY_LOW
                                        : quality == "medium" ? RTC_BUILD_QUALITY_MEDIUM
                                                              : RTC_BUILD_QUALITY_HIGH;
    const EmbreeScene scene(triangles, "threads=" + std::to_string(threads), RTC_SCENE_FLAG_NONE,
                            rtc_quality);
    return {scene.seconds(), scene.bytes()};
}

} // namespace peregrine::bench
