#include "exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace host {

namespace {

constexpr uint32_t probe_width = 64, probe_height = 36;
constexpr double patience = 0.1; // seconds between two measurements
constexpr float darkest = 1e-3f; // so that a few black pixels do not rule the mean
constexpr float lowest = 0.5f, highest = 8.0f;

// Geometric, as eyes compare light by ratios (Reinhard et al. 2002, equation 1).
float mean_luminance(const std::vector<float>& pixels) {
    double sum = 0.0;
    for (size_t i = 0; i < pixels.size(); i += 4) {
        const float luminance =
            0.2126f * pixels[i] + 0.7152f * pixels[i + 1] + 0.0722f * pixels[i + 2];
        sum += std::log(static_cast<double>(std::max(luminance, darkest)));
    }
    return static_cast<float>(std::exp(sum / (static_cast<double>(pixels.size()) / 4.0)));
}

} // namespace

float Exposure::wanted(const Viewpoint& viewpoint) const {
    Frame frame = session_.frame(probe_width, probe_height);
    frame.view = RT_VIEW_SHADED;
    frame.format = RT_FORMAT_RGBA32F;
    frame.tone_mapping = RT_TONE_NONE;
    std::vector<float> pixels(size_t{4} * probe_width * probe_height);
    session_.stage.render(viewpoint, frame, pixels.data());
    return std::clamp(std::pow(sight_.key / mean_luminance(pixels), sight_.adaptation), lowest,
                      highest);
}

float Exposure::settle(const Viewpoint& viewpoint) {
    goal_ = session_.options.exposure ? *session_.options.exposure : wanted(viewpoint);
    age_ = 0.0;
    return current_ = goal_;
}

float Exposure::drift(const Viewpoint& viewpoint, double seconds) {
    if (session_.options.exposure || current_ == 0.0f) return settle(viewpoint);
    age_ += seconds;
    if (age_ >= patience) {
        goal_ = wanted(viewpoint);
        age_ = 0.0;
    }
    const auto part = static_cast<float>(1.0 - std::exp(-2.0 * seconds));
    current_ *= std::pow(goal_ / current_, part);
    return current_;
}

} // namespace host
