#include "support/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace peregrine::test {
namespace {

using glm::vec3;

// ------------------------------------------------------------------------------- colour spaces

const glm::mat3 kRgbToXyz =
    glm::transpose(glm::dmat3{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794, //
                              2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,   //
                              1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382});
const glm::mat3 kXyzToRgb(glm::inverse(glm::dmat3(kRgbToXyz)));
const vec3 kWhite = kRgbToXyz * vec3(1);

float linear_of(uint8_t code) {
    const float x = float(code) / 255;
    return x > 0.04045f ? std::pow((x + 0.055f) / 1.055f, 2.4f) : x / 12.92f;
}

// The opponent space that is linear in XYZ: lightness, red-green, blue-yellow.
vec3 ycxcz_of(const vec3& rgb) {
    const vec3 xyz = kRgbToXyz * rgb / kWhite;
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}
vec3 rgb_of_ycxcz(const vec3& color) {
    const float y = (color.x + 16) / 116;
    return kXyzToRgb * (vec3(y + color.y / 500, y, y - color.z / 200) * kWhite);
}

// L*a*b*, with chroma that fades in the dark (Hunt's effect).
vec3 hunt_lab_of(const vec3& rgb) {
    constexpr float kDelta = 6.0f / 29;
    const vec3 xyz = kRgbToXyz * rgb / kWhite;
    vec3 f;
    for (int k = 0; k < 3; ++k)
        f[k] = xyz[k] > kDelta * kDelta * kDelta ? std::cbrt(xyz[k])
                                                 : xyz[k] / (3 * kDelta * kDelta) + 4.0f / 29;
    const float lightness = 116 * f.y - 16;
    return {lightness, 0.01f * lightness * 500 * (f.x - f.y),
            0.01f * lightness * 200 * (f.y - f.z)};
}

// City-block in lightness, Euclidean in chroma (Abasi, Tehran, Fairchild 2020).
float hyab(const vec3& a, const vec3& b) {
    const vec3 d = a - b;
    return std::fabs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// ------------------------------------------------------------------------------------- filters

struct Plane {
    uint32_t width, height;
    std::vector<float> values;
};

// Weights of the offsets -radius .. radius.
using Kernel = std::vector<float>;

template <class Weight>
Kernel make_kernel(int radius, const Weight& weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(float(weight(double(i))));
    return kernel;
}

// Positive weights add up to 1, negative ones to -1.
Kernel normalised(Kernel kernel) {
    float positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += weight;
    for (float& weight : kernel) weight /= weight > 0 ? positive : -negative;
    return kernel;
}

// The border's pixels go on outside.
Plane filter(const Plane& in, const Kernel& across, const Kernel& down) {
    const auto width = int(in.width), height = int(in.height);
    const auto pass = [&](const std::vector<float>& from, const Kernel& kernel, bool horizontal) {
        const int radius = int(kernel.size()) / 2;
        std::vector<float> to(from.size(), 0.0f);
        for (int y = 0; y < height; ++y)
            for (int k = -radius; k <= radius; ++k) {
                const float weight = kernel[size_t(k + radius)];
                const int row = horizontal ? y : std::clamp(y + k, 0, height - 1);
                const float* const source = from.data() + size_t(row) * in.width;
                float* const target = to.data() + size_t(y) * in.width;
                for (int x = 0; x < width; ++x)
                    target[x] += weight * source[horizontal ? std::clamp(x + k, 0, width - 1) : x];
            }
        return to;
    };
    return {in.width, in.height, pass(pass(in.values, across, true), down, false)};
}

// A sum of two Gaussians in the frequency domain is one in space; 3.1 and table 1 of the paper.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

// How the eye blurs a channel of the opponent space at this distance.
Plane blur(const Plane& in, const Sensitivity& s, float pixels_per_degree) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kWidest = 0.04; // of all b
    const auto radius =
        int(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
    Plane sum{in.width, in.height, std::vector<float>(in.values.size(), 0.0f)};
    struct Part {
        double share;
        Kernel kernel;
    };
    std::vector<Part> parts;
    double all = 0;
    for (const auto& [a, b] : {std::pair(s.a1, s.b1), std::pair(s.a2, s.b2)}) {
        if (a == 0) continue;
        const Kernel kernel = make_kernel(radius, [&](double i) {
            const double degrees = i / double(pixels_per_degree);
            return std::exp(-kPi * kPi * degrees * degrees / b);
        });
        double weight = 0;
        for (const float w : kernel) weight += double(w);
        const double share = a * std::sqrt(kPi / b) * weight * weight;
        parts.push_back({share, normalised(kernel)});
        all += share;
    }
    for (const Part& part : parts) {
        const Plane blurred = filter(in, part.kernel, part.kernel);
        for (size_t i = 0; i < sum.values.size(); ++i)
            sum.values[i] += float(part.share / all) * blurred.values[i];
    }
    return sum;
}

// ------------------------------------------------------------------------------------ pipelines

// A picture as the metric wants it.
struct Seen {
    std::vector<vec3> colors;         // blurred, in Hunt's L*a*b*
    std::vector<float> edges, points; // strength of the features of the lightness
};

// The lengths of the vectors of a filter along x and along y; 3.2.
std::vector<float> detect(const Plane& lightness, const Kernel& feature, const Kernel& smooth) {
    const Plane x = filter(lightness, feature, smooth), y = filter(lightness, smooth, feature);
    std::vector<float> strength(x.values.size());
    for (size_t i = 0; i < strength.size(); ++i) strength[i] = std::hypot(x.values[i], y.values[i]);
    return strength;
}

Seen look_at(const uint8_t* picture, uint32_t width, uint32_t height, float pixels_per_degree) {
    const size_t count = size_t(width) * height;
    std::array<float, 256> linear;
    for (int code = 0; code < 256; ++code) linear[size_t(code)] = linear_of(uint8_t(code));
    Plane channels[3];
    for (Plane& channel : channels) channel = {width, height, std::vector<float>(count)};
    for (size_t i = 0; i < count; ++i) {
        const uint8_t* const p = picture + 4 * i;
        const vec3 color = ycxcz_of({linear[p[0]], linear[p[1]], linear[p[2]]});
        for (int k = 0; k < 3; ++k) channels[k].values[i] = color[k];
    }

    Seen seen;
    Plane lightness = channels[0];
    for (float& value : lightness.values) value = (value + 16) / 116;
    const double deviation = 0.5 * 0.082 * double(pixels_per_degree); // of the eye's edge detector
    const auto radius = int(std::ceil(3 * deviation));
    const auto gauss = [&](double i) { return std::exp(-i * i / (2 * deviation * deviation)); };
    const Kernel smooth = normalised(make_kernel(radius, gauss));
    const Kernel edge = normalised(make_kernel(radius, [&](double i) { return -i * gauss(i); }));
    const Kernel point = normalised(make_kernel(
        radius, [&](double i) { return (i * i / (deviation * deviation) - 1) * gauss(i); }));
    seen.edges = detect(lightness, edge, smooth);
    seen.points = detect(lightness, point, smooth);

    for (int k = 0; k < 3; ++k) channels[k] = blur(channels[k], kSensitivity[k], pixels_per_degree);
    for (size_t i = 0; i < count; ++i) {
        const vec3 rgb =
            rgb_of_ycxcz({channels[0].values[i], channels[1].values[i], channels[2].values[i]});
        seen.colors.push_back(hunt_lab_of(glm::clamp(rgb, 0.0f, 1.0f)));
    }
    return seen;
}

// 3.1.3: large differences of colour are pressed into the last twentieth.
float color_error(const vec3& a, const vec3& b) {
    constexpr float kExponent = 0.7f, kKnee = 0.4f, kBelowKnee = 0.95f;
    static const float most =
        std::pow(hyab(hunt_lab_of({0, 1, 0}), hunt_lab_of({0, 0, 1})), kExponent);
    const float knee = kKnee * most;
    const float error = std::pow(hyab(a, b), kExponent);
    if (error < knee) return kBelowKnee / knee * error;
    return kBelowKnee + (error - knee) / (most - knee) * (1 - kBelowKnee);
}

} // namespace

FlipMap flip(const uint8_t* reference, const uint8_t* test, uint32_t width, uint32_t height,
             float pixels_per_degree) {
    const Seen a = look_at(reference, width, height, pixels_per_degree);
    const Seen b = look_at(test, width, height, pixels_per_degree);
    FlipMap map{width, height, std::vector<float>(size_t(width) * height)};
    for (size_t i = 0; i < map.errors.size(); ++i) {
        const float feature =
            std::max(std::fabs(a.edges[i] - b.edges[i]), std::fabs(a.points[i] - b.points[i]));
        const float feature_error = std::sqrt(feature / std::numbers::sqrt2_v<float>);
        map.errors[i] = std::pow(color_error(a.colors[i], b.colors[i]), 1 - feature_error);
    }
    return map;
}

double FlipMap::mean() const {
    double sum = 0;
    for (const float error : errors) sum += double(error);
    return errors.empty() ? 0 : sum / double(errors.size());
}

double FlipMap::worst_tile(uint32_t size) const {
    double worst = 0;
    for (uint32_t top = 0; top < height; top += size)
        for (uint32_t left = 0; left < width; left += size) {
            const uint32_t bottom = std::min(top + size, height);
            const uint32_t right = std::min(left + size, width);
            double sum = 0;
            for (uint32_t y = top; y < bottom; ++y)
                for (uint32_t x = left; x < right; ++x)
                    sum += double(errors[size_t(y) * width + x]);
            worst = std::max(worst, sum / (double(bottom - top) * double(right - left)));
        }
    return worst;
}

} // namespace peregrine::test
