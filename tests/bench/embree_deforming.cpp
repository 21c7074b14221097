#include "embree_peer.h"

#include "timing.h"

#include <cstring>
#include <embree3/rtcore.h>
#include <stdexcept>

namespace peregrine::bench {
namespace {

class EmbreeDeforming final : public PeerDeforming {
public:
    EmbreeDeforming(std::span<const uint32_t> indices, std::span<const math::Vec3> positions,
                    uint32_t threads, bool refit)
        : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())) {
        if (!device_) throw std::runtime_error("Embree cannot start");
        mesh_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        vertices_ = rtcSetNewGeometryBuffer(mesh_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(math::Vec3), positions.size());
        void* const corners = rtcSetNewGeometryBuffer(mesh_, RTC_BUFFER_TYPE_INDEX, 0,
                                                      RTC_FORMAT_UINT3, 12, indices.size() / 3);
        std::memcpy(corners, indices.data(), indices.size_bytes());
        rtcSetGeometryBuildQuality(mesh_, refit ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_LOW);
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
        rtcAttachGeometry(scene_, mesh_);
        deform(positions);
    }
    ~EmbreeDeforming() override {
        rtcReleaseScene(scene_);
        rtcReleaseGeometry(mesh_);
        rtcReleaseDevice(device_);
    }

    double deform(std::span<const math::Vec3> positions) override {
        const double start = process_seconds();
        std::memcpy(vertices_, positions.data(), positions.size_bytes());
        rtcUpdateGeometryBuffer(mesh_, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(mesh_);
        rtcCommitScene(scene_);
        return process_seconds() - start;
    }

private:
    RTCDevice device_;
    RTCGeometry mesh_;
    RTCScene scene_;
    void* vertices_;
};

} // namespace

std::unique_ptr<PeerDeforming> deform_with_embree(std::span<const uint32_t> indices,
                                                  std::span<const math::Vec3> positions,
                                                  uint32_t threads, bool refit) {
    return std::make_unique<EmbreeDeforming>(indices, positions, threads, refit);
}

} // namespace peregrine::bench
