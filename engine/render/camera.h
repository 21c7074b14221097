#pragma once

#include "math/ray.h"
#include "math/vec.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace peregrine::render {

struct Camera {
    float vertical_fov = 1.0471976f; // radians
    math::Vec3d position{0};
    math::Vec3 forward{0, 0, -1}; // any length but zero
    math::Vec3 up{0, 1, 0};       // not parallel to forward
};

// The pinhole of a camera over an image: pixel (0, 0) is the top left one, rays pass through the
// pixels' centres. Directions are not unit: their component along `forward` is 1.
struct Pinhole {
    math::Vec3 origin;
    math::Vec3 corner; // direction through the image's top left corner
    math::Vec3 right;  // by one pixel
    math::Vec3 down;
    float pixel_width; // at t = 1

    Pinhole(const Camera& camera, uint32_t width, uint32_t height) {
        using math::Vec3d;
        const Vec3d forward = glm::normalize(Vec3d(camera.forward));
        const Vec3d side = glm::normalize(glm::cross(forward, Vec3d(camera.up)));
        const Vec3d up = glm::cross(side, forward);
        const double pixel = 2.0 * std::tan(double(camera.vertical_fov) * 0.5) / double(height);
        origin = math::Vec3(camera.position);
        right = math::Vec3(side * pixel);
        down = math::Vec3(-up * pixel);
        pixel_width = float(pixel);
        corner = math::Vec3(forward - side * (pixel * 0.5 * double(width))
                            + up * (pixel * 0.5 * double(height)));
    }

    math::Vec3 direction(uint32_t x, uint32_t y) const {
        return (corner + right * (float(x) + 0.5f)) + down * (float(y) + 0.5f);
    }

    math::Ray primary(uint32_t x, uint32_t y) const {
        return {origin, 0.0f, direction(x, y), std::numeric_limits<float>::infinity()};
    }
};

} // namespace peregrine::render
