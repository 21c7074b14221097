#pragma once

#include <cstdint>

namespace peregrine::scene {

struct Environment;
struct Fog;
struct Light;
struct Material;

// What a scene has, found at commit. Materials count if a mesh shows them, not if they are merely
// described. Work for a feature that is absent is left out (promise 3 of docs/design.md). The
// values are those of RT_FEATURE_*.
enum Feature : uint32_t {
    kTextures = 1u << 0,
    kNormalMaps = 1u << 1,
    kEmissive = 1u << 2,
    kAlphaMask = 1u << 3,
    kSpecular = 1u << 4,
    kLights = 1u << 5,
    kShadows = 1u << 6,
    kDynamicMeshes = 1u << 7,
    kSingleSidedMaterials = 1u << 8,
    kReflection = 1u << 9,
    kTransmission = 1u << 10,
    kBlending = 1u << 11,
    kSky = 1u << 12,
    kFog = 1u << 13,
    kPrograms = 1u << 14,
    kProgramRays = 1u << 15,
    kAirlight = 1u << 16,
    kOcclusionTextures = 1u << 17,
    kRoughnessTextures = 1u << 18,
    kAllFeatures = (1u << 19) - 1,
};

// Of materials at which paths go on.
inline constexpr uint32_t kPathFeatures = kReflection | kTransmission | kBlending | kProgramRays;
// ... that light may pass.
inline constexpr uint32_t kLightPassingFeatures = kTransmission | kBlending;

uint32_t features_of(const Material& material);
uint32_t features_of(const Light& light);
uint32_t features_of(const Environment& environment);
uint32_t features_of(const Fog& fog);

} // namespace peregrine::scene
