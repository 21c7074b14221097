#pragma once

#include "geometry/triangle.h"

#include <cstdint>
#include <embree3/rtcore.h>
#include <span>
#include <string>

namespace peregrine::bench {

// Embree over one triangle mesh; its best quality has spatial splits.
class EmbreeScene {
public:
    EmbreeScene(std::span<const geometry::Triangle> triangles, const std::string& device_config,
                RTCSceneFlags flags, RTCBuildQuality quality = RTC_BUILD_QUALITY_HIGH);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene scene() const { return scene_; }
    double seconds() const { return seconds_; } // wall, of the structure
    uint64_t bytes() const { return bytes_; }   // of the structure, without vertices and indices

private:
    RTCDevice device_;
    RTCGeometry mesh_;
    RTCScene scene_;
    double seconds_;
    uint64_t bytes_;
};

} // namespace peregrine::bench
