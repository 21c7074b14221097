#pragma once

#include "math/ray.h"
#include "transpose.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <embree3/rtcore.h>

namespace peregrine::bench {

// N rays side by side as Embree wants them: packets of 4, 8 and 16, and one block of a stream.
template <size_t N>
struct alignas(64) EmbreeRays {
    float org_x[N], org_y[N], org_z[N], tnear[N];
    float dir_x[N], dir_y[N], dir_z[N], time[N];
    float tfar[N];
    uint32_t mask[N], id[N], flags[N];
};
template <size_t N>
struct EmbreeRayHits {
    EmbreeRays<N> ray;
    float ng_x[N], ng_y[N], ng_z[N], u[N], v[N];
    uint32_t triangle[N], mesh[N], instance[N];
};
static_assert(sizeof(EmbreeRays<16>) == sizeof(RTCRay16));
static_assert(sizeof(EmbreeRayHits<16>) == sizeof(RTCRayHit16));

// What stays the same from packet to packet.
template <size_t N>
void initialise(EmbreeRays<N>& packet) {
    std::memset(&packet, 0, sizeof packet);
    std::memset(packet.mask, 0xff, sizeof packet.mask);
}

// The places from `count` on get segments that hold no point.
template <size_t N>
void load_rays(const math::Ray* rays, size_t count, EmbreeRays<N>& packet) {
    math::Ray last[4];
    for (size_t i = 0; i < N; i += 4) {
        const math::Ray* four = rays + i;
        if (i + 4 > count) {
            for (size_t k = 0; k < 4; ++k)
                last[k] =
                    i + k < count ? rays[i + k] : math::Ray{math::Vec3(0), 1, math::Vec3(1), 0};
            four = last;
        }
        constexpr size_t stride = sizeof(math::Ray) / sizeof(float);
        transpose4(&four->origin.x, stride, packet.org_x + i, packet.org_y + i, packet.org_z + i,
                   packet.tnear + i);
        transpose4(&four->direction.x, stride, packet.dir_x + i, packet.dir_y + i, packet.dir_z + i,
                   packet.tfar + i);
    }
}

} // namespace peregrine::bench
