#include "embree_peer.h"

#include "timing.h"

#include <atomic>
#include <cstring>
#include <embree3/rtcore.h>
#include <stdexcept>
#include <string>

namespace peregrine::bench {

bool has_embree() {
    return true;
}

PeerBuild build_with_embree(std::span<const geometry::Triangle> triangles, uint32_t threads) {
    RTCDevice device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    if (!device) throw std::runtime_error("Embree cannot start");
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles.size()));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
    for (size_t i = 0; i < triangles.size(); ++i) {
        std::memcpy(vertices + 9 * i, &triangles[i].v0, 12);
        std::memcpy(vertices + 9 * i + 3, &triangles[i].v1, 12);
        std::memcpy(vertices + 9 * i + 6, &triangles[i].v2, 12);
        for (uint32_t k = 0; k < 3; ++k) indices[3 * i + k] = uint32_t(3 * i + k);
    }
    rtcSetGeometryBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(mesh);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene, mesh);

    std::atomic<int64_t> bytes{0};
    rtcSetDeviceMemoryMonitorFunction(
        device,
        [](void* user, ssize_t change, bool) {
            *static_cast<std::atomic<int64_t>*>(user) += change;
            return true;
        },
        &bytes);
    const double start = wall_seconds();
    rtcCommitScene(scene);
    const PeerBuild result{wall_seconds() - start, uint64_t(bytes.load())};
    rtcSetDeviceMemoryMonitorFunction(device, nullptr, nullptr);
    rtcReleaseScene(scene);
    rtcReleaseGeometry(mesh);
    rtcReleaseDevice(device);
    return result;
}

} // namespace peregrine::bench
