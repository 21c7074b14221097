#include "embree_scene.h"

#include "timing.h"

#include <atomic>
#include <cstring>
#include <stdexcept>

namespace peregrine::bench {

EmbreeScene::EmbreeScene(std::span<const geometry::Triangle> triangles,
                         const std::string& device_config, RTCSceneFlags flags,
                         RTCBuildQuality quality)
    : device_(rtcNewDevice(device_config.c_str())) {
    if (!device_) throw std::runtime_error("Embree cannot start");
    mesh_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles.size()));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        mesh_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i) {
        std::memcpy(vertices + 9 * i, &triangles[i].v0, 12);
        std::memcpy(vertices + 9 * i + 3, &triangles[i].v1, 12);
        std::memcpy(vertices + 9 * i + 6, &triangles[i].v2, 12);
        for (uint32_t k = 0; k < 3; ++k) indices[3 * i + k] = uint32_t(3 * i + k);
    }
    rtcSetGeometryBuildQuality(mesh_, quality);
    rtcCommitGeometry(mesh_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, quality);
    rtcSetSceneFlags(scene_, flags);
    rtcAttachGeometry(scene_, mesh_);

    std::atomic<int64_t> bytes{0};
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* user, ssize_t change, bool) {
            *static_cast<std::atomic<int64_t>*>(user) += change;
            return true;
        },
        &bytes);
    const double start = wall_seconds();
    rtcCommitScene(scene_);
    seconds_ = wall_seconds() - start;
    bytes_ = uint64_t(bytes.load());
    rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseGeometry(mesh_);
    rtcReleaseDevice(device_);
}

} // namespace peregrine::bench
