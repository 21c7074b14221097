#pragma once

#include "query/records.h"
#include "query/resolve.h"
#include "query/shapes.h"

#include <limits>

// What results say of records that are not valid where a request wants the others answered
// (Request::mark_invalid).
namespace peregrine::query {

inline constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
inline constexpr uint8_t kInvalidByte = 0xff;
inline constexpr uint32_t kInvalidCount = ~0u;

inline constexpr Hit kInvalidHit = {
    kNotANumber, kNotANumber, kNotANumber, geometry::kNoTriangle, {}, 0, 0};

inline Surface invalid_surface() {
    Surface surface;
    surface.position = math::Vec3d(std::numeric_limits<double>::quiet_NaN());
    return surface;
}

inline SweepHit no_contact(float t) {
    return {t, math::Vec3(0), math::Vec3(0), 0, geometry::kNoTriangle, {}, 0};
}
inline NearestPoint no_point(float distance) {
    return {distance, math::Vec3(0), math::Vec3(0), 0, 0, geometry::kNoTriangle, {}};
}

// Hit i and what lies there, if that is wanted.
inline void mark(uint64_t i, const Hits& hits, const Surfaces& surfaces) {
    hits.store(i, kInvalidHit);
    if (surfaces) surfaces.store(i, invalid_surface());
}

// A ray that hits nothing, in the place of one that is not valid.
inline constexpr float kNoRay[8] = {0, 0, 0, 0, 0, 0, 1, -1};

} // namespace peregrine::query
