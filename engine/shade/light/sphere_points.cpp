#include "shade/light/sphere_points.h"

#include <array>
#include <cmath>

namespace peregrine::shade {
namespace {

using math::Vec3;

constexpr float kRim = 0.95f;
constexpr Vec3 kProbes[kSphereProbes] = {{kRim, 0, 0},  {-kRim, 0, 0}, {0, kRim, 0},
                                         {0, -kRim, 0}, {0, 0, kRim},  {0, 0, -kRim}};

using Points = std::array<Vec3, kMostSpherePoints>;

Points make_points() {
    constexpr double kPhi = 1.1673039782614187; // kPhi^5 = kPhi + 1
    Points points;
    double at[4] = {0.5, 0.5, 0.5, 0.5};
    for (uint32_t i = 0; i < kMostSpherePoints;) {
        double x[4], step = 1;
        for (int k = 0; k < 4; ++k) {
            step /= kPhi;
            at[k] += step;
            at[k] -= std::floor(at[k]);
            x[k] = 2 * at[k] - 1;
        }
        const double first = x[0] * x[0] + x[1] * x[1], second = x[2] * x[2] + x[3] * x[3];
        if (first >= 1 || second >= 1 || second == 0) continue;
        const double z = x[2] * std::sqrt((1 - first) / second);
        const Vec3 point{float(x[0]), float(x[1]), float(z)};
        points[i++] = point;
        points[i++] = -point;
    }
    return points;
}

} // namespace

std::span<const Vec3, kSphereProbes> sphere_probes() {
    return kProbes;
}

std::span<const Vec3, kMostSpherePoints> sphere_points() {
    static const Points points = make_points();
    return points;
}

} // namespace peregrine::shade
