#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace peregrine::report {

struct Color {
    double r, g, b; // 0 to 1, as shown
};

// A map seen from above: x to the right, z downward, in metres.
class Canvas {
public:
    Canvas(double x0, double z0, double x1, double z1, double pixels_a_metre);

    uint32_t width() const { return width_; }
    uint32_t height() const { return height_; }
    double x_of(uint32_t column) const { return x0_ + (column + 0.5) / scale_; }
    double z_of(uint32_t row) const { return z0_ + (row + 0.5) / scale_; }

    const Color& pixel(size_t i) const { return pixels_[i]; }
    void set(uint32_t column, uint32_t row, const Color& color);
    // Smooth shapes, over what is there.
    void line(double ax, double az, double bx, double bz, double width, const Color& color,
              double opacity = 1);
    void disc(double x, double z, double radius, const Color& color, double opacity = 1);
    void ring(double x, double z, double radius, double width, const Color& color);

    void write(const std::string& path) const;

private:
    void blend(int64_t column, int64_t row, const Color& color, double part);
    // Calls shade(x, z), the part covered of the pixel there, over a rectangle.
    template <class Shade>
    void paint(double ax, double az, double bx, double bz, const Color& color, Shade&& shade);

    double x0_, z0_, scale_;
    uint32_t width_, height_;
    std::vector<Color> pixels_;
};

} // namespace peregrine::report
