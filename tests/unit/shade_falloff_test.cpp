#include "scene/lights/falloff.h"
#include "shade/material/highlight.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::shade {
namespace {

using scene::kCosine, scene::kCosineLinear, scene::kLinear, scene::kSchlickBend,
    scene::kSchlickLinear, scene::PaperFalloff;

// The price of each approximation over [0.1, 0.8] of the radius, measured against 1 / x^2; `curve`
// is K times the shape.
template <class Curve>
void expect_error(const PaperFalloff& falloff, double root_mean_square, Curve&& curve) {
    double largest = 0, squares = 0;
    int count = 0;
    for (double x = 0.1; x <= 0.8; x += 0.0005, ++count) {
        const double error = std::log(double(falloff.gain) * curve(x) * x * x);
        largest = std::max(largest, std::fabs(error));
        squares += error * error;
    }
    EXPECT_LE(std::exp(largest), double(falloff.error));
    EXPECT_GE(std::exp(largest), double(falloff.error) - 0.003) << "the statement is not tight";
    EXPECT_NEAR(std::exp(std::sqrt(squares / count)), root_mean_square, 0.005);
}

double cosine(double x) {
    const double y = x * x;
    const auto c = [](int k) { return double(kCosine[k]); };
    return (1 - y) * (1 + y * (c(0) + y * (c(1) + y * c(2))));
}

TEST(Falloff, StaysWithinItsStatedErrorOfTheInverseSquare) {
    expect_error(kSchlickLinear, 1.584,
                 [](double x) { return (1 - x) * (1 - x) / (1 + double(kSchlickBend) * x); });
    expect_error(kCosineLinear, 2.006, [](double x) { return cosine(x) * cosine(x) * (1 - x); });
    expect_error(kLinear, 2.913, [](double x) { return 1 - x; });
}

TEST(Falloff, ItsCosineIsOne) {
    for (double x = 0; x < 1; x += 0.001)
        EXPECT_NEAR(cosine(x) / std::cos(1.5707963267948966 * x), 1, 2.5e-7) << x;
    EXPECT_EQ(cosine(1), 0);
}

TEST(Highlight, GainConservesEnergyHeadOn) {
    for (const float n : {1.0f, 1.02f, 1.2f, 2.0f, 8.0f, 32.0f, 128.0f, 1000.0f, 1e5f}) {
        double integral = 0;
        const int steps = 2000000;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps;
            integral += t * t / (double(n) - (double(n) - 1) * t) / steps;
        }
        EXPECT_NEAR(highlight_gain(n) * 6.283185307179586 * integral, 1.0, 2e-3) << n;
    }
}

} // namespace
} // namespace peregrine::shade
