#include "canvas.h"

#include "image_file.h"

#include <algorithm>
#include <cmath>

namespace peregrine::report {

Canvas::Canvas(double x0, double z0, double x1, double z1, double pixels_a_metre)
    : x0_(x0), z0_(z0), scale_(pixels_a_metre),
      width_(uint32_t(std::lround((x1 - x0) * pixels_a_metre))),
      height_(uint32_t(std::lround((z1 - z0) * pixels_a_metre))),
      pixels_(size_t(width_) * height_, Color{1, 1, 1}) {}

void Canvas::set(uint32_t column, uint32_t row, const Color& color) {
    pixels_[size_t(row) * width_ + column] = color;
}

void Canvas::blend(int64_t column, int64_t row, const Color& color, double part) {
    Color& pixel = pixels_[size_t(row) * width_ + size_t(column)];
    pixel.r += (color.r - pixel.r) * part;
    pixel.g += (color.g - pixel.g) * part;
    pixel.b += (color.b - pixel.b) * part;
}

template <class Shade>
void Canvas::paint(double ax, double az, double bx, double bz, const Color& color, Shade&& shade) {
    const auto clamp = [](double value, uint32_t size) {
        return std::clamp(int64_t(std::floor(value)), int64_t(0), int64_t(size));
    };
    const int64_t c0 = clamp((ax - x0_) * scale_ - 1, width_);
    const int64_t c1 = clamp((bx - x0_) * scale_ + 2, width_);
    const int64_t r0 = clamp((az - z0_) * scale_ - 1, height_);
    const int64_t r1 = clamp((bz - z0_) * scale_ + 2, height_);
    for (int64_t row = r0; row < r1; ++row)
        for (int64_t column = c0; column < c1; ++column) {
            const double part = shade(x_of(uint32_t(column)), z_of(uint32_t(row)));
            if (part > 0) blend(column, row, color, std::min(part, 1.0));
        }
}

void Canvas::line(double ax, double az, double bx, double bz, double width, const Color& color,
                  double opacity) {
    const double dx = bx - ax, dz = bz - az;
    const double length2 = std::max(dx * dx + dz * dz, 1e-12);
    const double half = width / 2;
    paint(std::min(ax, bx) - half, std::min(az, bz) - half, std::max(ax, bx) + half,
          std::max(az, bz) + half, color, [&](double x, double z) {
              const double s = std::clamp(((x - ax) * dx + (z - az) * dz) / length2, 0.0, 1.0);
              const double away = std::hypot(x - ax - s * dx, z - az - s * dz);
              return opacity * std::clamp((half - away) * scale_ + 0.5, 0.0, 1.0);
          });
}

void Canvas::disc(double x, double z, double radius, const Color& color, double opacity) {
    paint(x - radius, z - radius, x + radius, z + radius, color, [&](double px, double pz) {
        const double away = std::hypot(px - x, pz - z);
        return opacity * std::clamp((radius - away) * scale_ + 0.5, 0.0, 1.0);
    });
}

void Canvas::ring(double x, double z, double radius, double width, const Color& color) {
    const double reach = radius + width;
    paint(x - reach, z - reach, x + reach, z + reach, color, [&](double px, double pz) {
        const double away = std::fabs(std::hypot(px - x, pz - z) - radius);
        return std::clamp((width / 2 - away) * scale_ + 0.5, 0.0, 1.0);
    });
}

void Canvas::write(const std::string& path) const {
    std::vector<uint8_t> bytes;
    bytes.reserve(pixels_.size() * 4);
    const auto byte = [](double value) {
        return uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    };
    for (const Color& pixel : pixels_) {
        const uint8_t rgba[] = {byte(pixel.r), byte(pixel.g), byte(pixel.b), 255};
        bytes.insert(bytes.end(), rgba, rgba + 4);
    }
    host::write_picture_file(path, width_, height_, bytes);
}

} // namespace peregrine::report
