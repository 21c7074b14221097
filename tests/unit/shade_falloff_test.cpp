#include "shade/falloff.h"
#include "shade/highlight.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace peregrine::shade {
namespace {

// Promise 4: the price of the approximation, measured against 1 / x^2.
TEST(Falloff, StaysWithinItsStatedErrorOfTheInverseSquare) {
    double largest = 0, squares = 0;
    int count = 0;
    for (double x = 0.1; x <= 0.8; x += 0.0005, ++count) {
        const double error = std::log(double(falloff(float(x))) * x * x);
        largest = std::max(largest, std::fabs(error));
        squares += error * error;
    }
    EXPECT_LE(std::exp(largest), double(kFalloffError));
    EXPECT_GE(std::exp(largest), double(kFalloffError) - 0.003) << "the statement is not tight";
    EXPECT_LE(std::exp(std::sqrt(squares / count)), 1.59);
}

TEST(Falloff, EndsSmoothlyAtTheRadiusAndIsFiniteAtTheLight) {
    EXPECT_EQ(falloff(1.0f), 0.0f);
    EXPECT_EQ(falloff(1.5f), 0.0f);
    EXPECT_LT(falloff(0.999f), 1e-4f); // zero slope: quadratic in 1 - x
    EXPECT_FLOAT_EQ(falloff(0.0f), kFalloffGain);
    for (float x = 0; x < 1; x += 0.01f) EXPECT_GT(falloff(x), falloff(x + 0.01f));
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
