#include "render/post/display_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peregrine::render::post {
namespace {

double srgb_to_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double inverse_of_clamp(double value) {
    return value;
}

// filmic_tone(x) = value is a quadratic equation in x with one positive root.
double inverse_of_filmic(double value) {
    const double a = 2.51 - 2.43 * value, b = 0.03 - 0.59 * value, c = -0.14 * value;
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

float smallest_float_from(double value) {
    const auto rounded = float(value);
    return double(rounded) >= value
               ? rounded
               : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

} // namespace

const DisplayCurve& DisplayCurve::clamp() {
    static const DisplayCurve curve(inverse_of_clamp);
    return curve;
}

const DisplayCurve& DisplayCurve::filmic() {
    static const DisplayCurve curve(inverse_of_filmic);
    return curve;
}

DisplayCurve::DisplayCurve(double (*inverse)(double)) {
    threshold_[0] = 0;
    for (int code = 1; code < 256; ++code)
        threshold_[code] = smallest_float_from(inverse(srgb_to_linear((code - 0.5) / 255.0)));
    threshold_[256] = std::numeric_limits<float>::infinity();
    uint32_t code = 0;
    for (uint32_t bin = 0; bin < kBins; ++bin) {
        const uint32_t first = (kFirstBin + bin) << kShift;
        while (threshold_[code + 1] <= std::bit_cast<float>(first)) ++code;
        const uint32_t until_next = std::bit_cast<uint32_t>(threshold_[code + 1]) - first;
        const uint32_t carried = until_next <= kLowerBits ? kLowerBits + 1 - until_next : 0;
        bins_[bin] = (code << kShift) + carried;
    }
}

// What reflects the part p of the light shows p dimmest or more, and p times a change. The slope is
// at most that of the steepest step from the one before on: the curves are bent. Within a step p is
// largest at its end.
double DisplayCurve::most_steps(float dimmest) const {
    double steepest = 0, most = 0;
    for (int code = 254; code >= 1; --code) {
        const int before = std::max(code - 1, 1);
        for (const int step : {code, before}) {
            const double width = double(threshold_[step + 1]) - double(threshold_[step]);
            steepest = std::max(steepest, 1 / width);
        }
        const double part = double(threshold_[code + 1]) / double(dimmest);
        most = std::max(most, std::min(1.0, part) * steepest);
    }
    return most;
}

} // namespace peregrine::render::post
